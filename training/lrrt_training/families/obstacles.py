# SPDX-License-Identifier: BSD-3-Clause
"""Obstacles in the open: scattered shapes, forests, bug traps, walls with narrow gaps."""

from __future__ import annotations

import math

import numpy as np

from lrrt_training.families.draw import (
    Shape,
    chance,
    disc_offsets,
    fill_box,
    fill_disc,
    fill_rectangle,
    frame,
    log_uniform,
    random_shape,
    smooth_noise,
    square_offsets,
    stamp,
    stroke,
)

FEWEST_SHAPES, MOST_SHAPES = 8, 120


def scattered_shapes(rng: np.random.Generator, side: int) -> np.ndarray:
    """Discs and boxes, upright or turned, of one size or of many, at densities from sparse to crowded."""
    shape = random_shape(rng, side)
    occupied = np.zeros(shape, dtype=bool)
    typical = log_uniform(rng, side / 60, side / 12)
    variety = rng.uniform(0.0, 0.6)
    wanted = -math.log1p(-rng.uniform(0.12, 0.5)) * shape[0] * shape[1]  # shapes overlap
    count = int(min(MOST_SHAPES, max(FEWEST_SHAPES, wanted / (3.5 * typical**2 * math.exp(variety**2)))))
    kinds = rng.dirichlet((1.0, 1.0, 1.0)) if chance(rng, 0.6) else np.eye(3)[rng.integers(3)]
    places = rng.random((count, 2)) * shape
    sizes = typical * np.exp(variety * rng.standard_normal((count, 2)))
    angles = rng.uniform(0, math.pi, count)
    for place, (one, other), angle, kind in zip(places, sizes, angles, rng.choice(3, count, p=kinds)):
        if kind == 0:
            fill_disc(occupied, place, one)
        elif kind == 1:
            fill_rectangle(occupied, place[0] - one, place[1] - other, 2 * one, 2 * other)
        else:
            fill_box(occupied, place, (one, other), angle)
    if chance(rng, 0.3):
        frame(occupied, int(rng.integers(1, 4)))
    return occupied


def _plant(rng: np.random.Generator, occupied: np.ndarray, share: float) -> None:
    """Adds trees, small discs or squares, that cover about ``share`` of the map."""
    height, width = occupied.shape
    unit = max(height, width) / 256
    diameter = max(2, round(log_uniform(rng, 2.5, 11) * unit))
    square = chance(rng, 0.5)
    count = int(share * height * width / diameter**2 / (1.0 if square else 0.8)) + 1
    if chance(rng, 0.4):  # an orchard: rows and columns with some disorder
        pitch = math.sqrt(height * width / count)
        grid = np.stack(np.meshgrid(np.arange(0, height, pitch), np.arange(0, width, pitch), indexing="ij"), axis=-1)
        places = grid.reshape(-1, 2) + rng.uniform(0, pitch * rng.uniform(0.2, 1.0), (grid.size // 2, 2))
    else:
        places = rng.random((count, 2)) * occupied.shape
    sizes = {diameter, max(2, diameter // 2)} if chance(rng, 0.4) else {diameter}
    group = rng.integers(len(sizes), size=len(places))
    for i, size in enumerate(sorted(sizes)):
        stamp(occupied, places[group == i], square_offsets(size) if square else disc_offsets(size))


def forest(rng: np.random.Generator, side: int) -> np.ndarray:
    """Many small discs or squares, in thickets or rows, sometimes with clearings."""
    occupied = np.zeros(random_shape(rng, side), dtype=bool)
    _plant(rng, occupied, rng.uniform(0.05, 0.28))
    if chance(rng, 0.3):
        occupied &= smooth_noise(rng, occupied.shape, side / 4) > -0.6
    if chance(rng, 0.3):
        frame(occupied, int(rng.integers(1, 4)))
    return occupied if occupied.any() else forest(rng, side)


def _turned(corners, angle: float) -> np.ndarray:
    cosine, sine = math.cos(angle), math.sin(angle)
    return np.asarray(corners, dtype=float) @ np.array([[cosine, sine], [-sine, cosine]])


def _u_shape(rng: np.random.Generator, radius: float) -> list[np.ndarray]:
    """A U, maybe with lips that narrow its mouth."""
    wide, deep = radius * rng.uniform(0.45, 0.8, size=2)
    corners = [(-deep, -wide), (deep, -wide), (deep, wide), (-deep, wide)]
    lip = wide * rng.uniform(0.2, 0.75)
    if chance(rng, 0.5):
        corners = [(-deep, lip - wide), *corners, (-deep, wide - lip)]
        if chance(rng, 0.4):  # lips that turn inwards: the classic trap
            inwards = deep * rng.uniform(0.0, 0.9)
            corners = [(inwards, lip - wide), *corners, (inwards, wide - lip)]
    return [np.array(corners)]


def _arc(rng: np.random.Generator, radius: float) -> list[np.ndarray]:
    """Most of a circle, or two of them, one in the other, whose mouths face away from each other."""
    mouth = rng.uniform(0.12, 0.8) * math.pi
    angles = np.linspace(mouth / 2, 2 * math.pi - mouth / 2, 40)
    circle = 0.9 * radius * np.stack((np.cos(angles), np.sin(angles)), axis=1)
    return [circle, -rng.uniform(0.4, 0.7) * circle] if chance(rng, 0.35) else [circle]


def _spiral(rng: np.random.Generator, radius: float, channel: float) -> list[np.ndarray]:
    """A spiral, round or square, as tight as the channel between its turns allows."""
    turns = max(1.0, min(rng.uniform(1.25, 3.5), 0.9 * radius / channel))
    if chance(rng, 0.5):
        angles = np.linspace(0.25, turns, max(8, int(turns * 32))) * 2 * math.pi
        return [(radius * angles / angles[-1])[:, None] * np.stack((np.cos(angles), np.sin(angles)), axis=1)]
    quarters = np.arange(1, max(4, round(4 * turns)) + 1)
    angles = (quarters + 0.5) * math.pi / 2
    return [(radius * quarters / quarters[-1])[:, None] * np.stack((np.cos(angles), np.sin(angles)), axis=1)]


def _places(rng: np.random.Generator, shape: Shape, count: int, radius: float) -> list[tuple[np.ndarray, float]]:
    """Centres and radii of discs that hardly overlap."""
    found: list[tuple[np.ndarray, float]] = []
    for _ in range(6 * count):
        size = radius * rng.uniform(0.6, 1.1)
        centre = rng.uniform(0.0, 1.0, 2) * (np.array(shape) - size) + size / 2
        if all(math.dist(centre, other) > 0.9 * (size + extent) for other, extent in found):
            found.append((centre, size))
            if len(found) == count:
                break
    return found


def bug_traps(rng: np.random.Generator, side: int) -> np.ndarray:
    """U shapes, rings with a mouth and spirals of any orientation, alone, many, nested, or in a forest."""
    shape = random_shape(rng, side)
    occupied = np.zeros(shape, dtype=bool)
    if chance(rng, 0.4):
        _plant(rng, occupied, rng.uniform(0.02, 0.1))
    count = int(rng.integers(1, 13))
    radius = min(shape) * min(0.46, log_uniform(rng, 0.5, 0.8) / math.sqrt(count))
    thickness = max(2, round(log_uniform(rng, 2, 9) * side / 256))
    upright = chance(rng, 0.4)
    for centre, size in _places(rng, shape, count, radius):
        if chance(rng, 0.4):  # no trees in the way
            fill_disc(occupied, centre, size, value=False)
        angle = math.pi / 2 * rng.integers(4) if upright else rng.uniform(0, 2 * math.pi)
        channel = thickness + max(4, 0.02 * side)
        kind = rng.random()
        if kind < 0.5 or size < 2.5 * channel:
            lines = _u_shape(rng, size)
            if size > 5 * channel and chance(rng, 0.3):  # one in the other, facing backwards
                lines += [-0.5 * line for line in lines]
        elif kind < 0.75:
            lines = _arc(rng, size)
        else:
            lines = _spiral(rng, size, channel)
        for line in lines:
            stroke(occupied, _turned(line, angle) + centre, thickness)
    if chance(rng, 0.3):
        frame(occupied, thickness)
    return occupied


def _barriers(rng: np.random.Generator, occupied: np.ndarray, angle: float, count: int, gap: float, wavy: bool) -> None:
    """Parallel walls across the whole map, each with one or two gaps."""
    height, width = occupied.shape
    side = max(height, width)
    rows, cols = np.arange(height, dtype=np.float32) - height / 2, np.arange(width, dtype=np.float32) - width / 2
    cosine, sine = np.float32(math.cos(angle)), np.float32(math.sin(angle))
    across = (rows * cosine)[:, None] + cols * sine
    along = (cols * cosine) - (rows * sine)[:, None]
    if wavy:
        across += smooth_noise(rng, occupied.shape, side / 4) * np.float32(side * rng.uniform(0.01, 0.04))
    reach = abs(height / 2 * cosine) + abs(width / 2 * sine)
    spacing = 2 * reach / (count + 1)
    thickest = max(2.0, min(side / 10, spacing / 3))
    thickness = log_uniform(rng, 2.0, thickest)
    for i in range(count):
        centre = -reach + spacing * (i + 1 + rng.uniform(-0.25, 0.25))
        wall = abs(across - np.float32(centre)) <= np.float32(thickness / 2)
        if not wall.any():
            continue
        places = along[wall]
        low, high = float(places.min()), float(places.max())
        for _ in range(2 if chance(rng, 0.35) else 1):
            wall &= abs(along - np.float32(rng.uniform(low + gap, high - gap))) > np.float32(gap / 2)
        occupied |= wall


def _cells(rng: np.random.Generator, occupied: np.ndarray, gap: int) -> None:
    """Walls in both directions, with gaps in (nearly) every piece of them."""
    thickness = int(rng.integers(2, max(3, max(occupied.shape) // 25)))
    lines = [np.sort(rng.choice(np.arange(1, 6), rng.integers(1, 4), replace=False)) * n // 6 for n in occupied.shape]
    for view, own in zip((occupied, occupied.T), lines):
        for at in own.tolist():
            view[at : at + thickness] = True
    for view, own, other in ((occupied, *lines), (occupied.T, *lines[::-1])):
        starts = [0, *(other + thickness).tolist()]
        ends = [*other.tolist(), view.shape[1]]
        for at in own.tolist():
            for start, end in zip(starts, ends):
                if chance(rng, 0.85):
                    place = int(rng.integers(start, max(start + 1, end - gap + 1)))
                    view[at : at + thickness, place : min(end, place + gap)] = False


def narrow_gaps(rng: np.random.Generator, side: int) -> np.ndarray:
    """Walls across the whole map, at any angle, with one or two narrow gaps each; alone or in a forest."""
    occupied = np.zeros(random_shape(rng, side), dtype=bool)
    if chance(rng, 0.45):
        _plant(rng, occupied, rng.uniform(0.02, 0.14))
    gap = max(3.0, log_uniform(rng, side / 80, side / 16))
    if chance(rng, 0.3):
        _cells(rng, occupied, round(gap))
    else:
        angle = math.pi / 2 * rng.integers(2) if chance(rng, 0.35) else rng.uniform(0, math.pi)
        _barriers(rng, occupied, angle, int(rng.integers(1, 8)), gap, chance(rng, 0.3))
    if chance(rng, 0.3):
        frame(occupied, int(rng.integers(1, 4)))
    return occupied
