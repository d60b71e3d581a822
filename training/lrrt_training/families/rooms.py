# SPDX-License-Identifier: BSD-3-Clause
"""Insides of buildings: rooms with doors, and offices along corridors."""

from __future__ import annotations

import math

import numpy as np

from lrrt_training.families.draw import chance, fill_box, fill_rectangle, frame, log_uniform, random_shape, widths

Room = tuple[int, int, int, int]  # top, left, height, width
Door = tuple[int, int, int, int]


def _split(rng: np.random.Generator, room: Room, wall: int, least: int) -> tuple[Room, Room, Room] | None:
    """The wall across the longer side of a room and the two rooms beside it."""
    top, left, height, width = room
    upright = width > height if abs(width - height) > 0.2 * width else chance(rng, 0.5)
    length = width if upright else height
    if length < 2 * least + wall:
        return None
    at = int(rng.integers(least, length - least - wall + 1))
    if upright:
        barrier = (top, left + at, height, wall)
        return barrier, (top, left, height, at), (top, left + at + wall, height, width - at - wall)
    barrier = (top + at, left, wall, width)
    return barrier, (top, left, at, width), (top + at + wall, left, height - at - wall, width)


def _doors(rng: np.random.Generator, barrier: Room, door: int, wall: int) -> list[Door]:
    """One or two openings of a wall, a little deeper than it: walls that end at a door make way."""
    top, left, height, width = barrier
    upright = height > width
    length = height if upright else width
    size = min(door, length)
    doors = []
    for _ in range(2 if chance(rng, 0.3) else 1):
        at = int(rng.integers(length - size + 1))
        depth = wall + 2 * size
        doors.append((top + at, left - size, size, depth) if upright else (top - size, left + at, depth, size))
    return doors


def _furnish(rng: np.random.Generator, occupied: np.ndarray, room: Room, margin: int) -> None:
    """Boxes in a room, along a wall or anywhere."""
    top, left, height, width = room
    if min(height, width) < 4 * margin:
        return
    for _ in range(rng.integers(1, 5)):
        tall, wide = (max(2, int(n * rng.uniform(0.08, 0.4))) for n in (height, width))
        row, col = top + rng.integers(height - tall + 1), left + rng.integers(width - wide + 1)
        kind = rng.random()
        if kind < 0.4:
            row = top if chance(rng, 0.5) else top + height - tall
        elif kind > 0.8:
            fill_box(occupied, (row + tall / 2, col + wide / 2), (tall / 2, wide / 2), rng.uniform(0, math.pi))
            continue
        fill_rectangle(occupied, row, col, tall, wide)


def rooms(rng: np.random.Generator, side: int) -> np.ndarray:
    """Rooms of many sizes by binary space partition, with one or two doors a wall."""
    shape = random_shape(rng, side)
    wall = int(rng.integers(1, max(3, side // 50)))
    door = max(3, int(log_uniform(rng, side / 64, side / 14)))
    least = max(2 * door, int(log_uniform(rng, side / 14, side / 4)))
    occupied = np.zeros(shape, dtype=bool)
    frame(occupied, wall)
    waiting = [(wall, wall, shape[0] - 2 * wall, shape[1] - 2 * wall)]
    doors, leaves = [], []
    stop_early = rng.uniform(0.0, 0.25)
    while waiting:
        room = waiting.pop()
        small = room[2] * room[3] < shape[0] * shape[1] / 4
        parts = None if small and chance(rng, stop_early) else _split(rng, room, wall, least)
        if parts is None:
            leaves.append(room)
            continue
        fill_rectangle(occupied, *parts[0])
        doors += _doors(rng, parts[0], door, wall)
        waiting += parts[1:]
    furnished, solid = (rng.uniform(0.2, 0.9) if chance(rng, 0.6) else 0.0), 0.04
    for room in leaves:
        if chance(rng, solid):
            fill_rectangle(occupied, *room)
        elif chance(rng, furnished):
            _furnish(rng, occupied, room, door)
    for opening in doors:
        fill_rectangle(occupied, *opening, value=False)
    frame(occupied, wall)
    return occupied


def _offices(
    rng, occupied: np.ndarray, block: Room, beside: tuple[bool, bool], wall: int, door: int, style: dict
) -> None:
    """Carves one or two rows of offices out of a solid block.

    Doors open to the corridors above and below it, where ``beside`` says that there is one, or else to the other row.
    """
    top, left, height, width = block
    two = height >= 2 * style["depth"] + 3 * wall
    deep = (height - 3 * wall) // 2 if two else height - 2 * wall
    count = max(1, (width - wall) // (style["length"] + wall))
    if deep < 4 or width - wall * (count + 1) < 4 * count:
        return
    single = beside[0] if beside[0] != beside[1] else chance(rng, 0.5)
    for upper in (True, False) if two else (single,):
        row = top + wall if upper or not two else top + height - wall - deep
        col = left + wall
        for length in widths(rng, width - wall * (count + 1), count, 4, style["spread"]).tolist():
            fill_rectangle(occupied, row, col, deep, length, value=False)
            if chance(rng, style["furnished"]):
                _furnish(rng, occupied, (row, col, deep, length), door)
            size = min(door, length)
            at = col + int(rng.integers(length - size + 1))
            if not chance(rng, style["closed"]):
                upwards = upper == beside[0 if upper else 1]
                across = height - 2 * deep - 2 * wall + 2 if two and upwards != upper else wall + 1
                fill_rectangle(occupied, row + 1 - across if upwards else row + deep - 1, at, across, size, value=False)
            if col > left + wall and chance(rng, style["linked"]):  # a door to the office before it
                at = row + int(rng.integers(deep - min(door, deep) + 1))
                fill_rectangle(occupied, at, col - wall - 1, min(door, deep), wall + 2, value=False)
            col += length + wall


def office(rng: np.random.Generator, side: int) -> np.ndarray:
    """A grid of corridors with offices on both sides, some of which are shut."""
    shape = random_shape(rng, side)
    turned = chance(rng, 0.5)
    height, width = shape[::-1] if turned else shape
    wall = int(rng.integers(1, max(3, side // 70)))
    corridor = max(4, int(log_uniform(rng, side / 50, side / 14)))
    door = max(3, min(corridor, int(log_uniform(rng, side / 80, side / 24))))
    depth = max(door + 3, int(log_uniform(rng, side / 16, side / 6)))
    style = {
        "depth": depth,
        "length": max(door + 2, int(depth * log_uniform(rng, 0.6, 1.8))),
        "spread": rng.uniform(0.0, 0.6),
        "furnished": rng.uniform(0.0, 0.6) if chance(rng, 0.5) else 0.0,
        "closed": rng.uniform(0.0, 0.35),
        "linked": rng.uniform(0.0, 0.3) if chance(rng, 0.5) else 0.0,
    }
    deck = 2 * depth + 3 * wall + corridor
    across = max(1, (height - corridor) // deck)
    along = int(rng.integers(1, max(2, width // max(1, 3 * depth)) + 1))
    ring = chance(rng, 0.5)  # a corridor all around, or offices up to the outer wall
    occupied = np.ones((height, width), dtype=bool)
    edge = wall + corridor if ring else 0
    block_heights = widths(rng, height - 2 * edge - corridor * (across - 1), across, 8, 0.25)
    block_widths = widths(rng, width - 2 * edge - corridor * (along - 1), along, 8, 0.4)
    tops = edge + np.concatenate(([0], (block_heights + corridor).cumsum()))
    lefts = edge + np.concatenate(([0], (block_widths + corridor).cumsum()))
    inner = (slice(wall, height - wall), slice(wall, width - wall))
    for top in tops[0 if ring else 1 : None if ring else -1].tolist() + ([edge - corridor] if ring else []):
        occupied[max(0, top - corridor) : top, inner[1]] = False
    for left in lefts[0 if ring else 1 : None if ring else -1].tolist() + ([edge - corridor] if ring else []):
        occupied[inner[0], max(0, left - corridor) : left] = False
    for i, (top, tall) in enumerate(zip(tops.tolist(), block_heights.tolist())):
        beside = (ring or i > 0, ring or i + 1 < across)
        for left, wide in zip(lefts.tolist(), block_widths.tolist()):
            if chance(rng, 0.05):  # a hall
                fill_rectangle(occupied, top + wall, left + wall, tall - 2 * wall, wide - 2 * wall, value=False)
                fill_rectangle(occupied, top, left + wide // 3, tall, door, value=False)
            else:
                _offices(rng, occupied, (top, left, tall, wide), beside, wall, door, style)
    if chance(rng, 0.35):  # something bars a corridor
        for _ in range(rng.integers(1, 4)):
            if len(lefts) > 2 and chance(rng, 0.5):
                left = int(lefts[rng.integers(1, len(lefts) - 1)])
                fill_rectangle(occupied, rng.integers(height), left - corridor, wall + 1, corridor)
            elif len(tops) > 2:
                top = int(tops[rng.integers(1, len(tops) - 1)])
                fill_rectangle(occupied, top - corridor, rng.integers(width), corridor, wall + 1)
    frame(occupied, wall)
    return np.ascontiguousarray(occupied.T) if turned else occupied
