# SPDX-License-Identifier: BSD-3-Clause
"""City blocks between streets."""

from __future__ import annotations

import math

import numpy as np

from lrrt_training.families.draw import chance, fill_rectangle, frame, log_uniform, random_shape, stroke

Span = tuple[int, int]


def _lines(rng: np.random.Generator, length: int, block: float, street: float, variety: float) -> list[Span]:
    """Begin and end of the blocks along one axis; the streets between them differ in width."""
    spans = []
    at = -rng.uniform(0.0, block) if chance(rng, 0.5) else rng.uniform(0.5, 1.0) * street
    while at < length:
        size = max(4.0, block * math.exp(variety * rng.standard_normal()))
        spans.append((max(0, round(at)), min(length, round(at + size))))
        wide = 2.0 if chance(rng, 0.15) else 1.0
        at += size + max(3.0, wide * street * rng.uniform(0.7, 1.3))
    return [(a, b) for a, b in spans if b - a >= 3]


def _building(rng: np.random.Generator, occupied: np.ndarray, top: int, left: int, height: int, width: int) -> None:
    """One building: a box, an L, or a ring around a courtyard that may have a gate."""
    fill_rectangle(occupied, top, left, height, width)
    if min(height, width) < 10:
        return
    kind = rng.random()
    if kind < 0.15:  # an L
        tall, wide = height * rng.uniform(0.3, 0.6), width * rng.uniform(0.3, 0.6)
        row = top if chance(rng, 0.5) else top + height - tall
        col = left if chance(rng, 0.5) else left + width - wide
        fill_rectangle(occupied, row, col, tall, wide, value=False)
    elif kind < 0.35:  # a courtyard
        wing = max(2, int(min(height, width) * rng.uniform(0.15, 0.35)))
        fill_rectangle(occupied, top + wing, left + wing, height - 2 * wing, width - 2 * wing, value=False)
        if chance(rng, 0.75):
            gate = max(3, int(min(height, width) * rng.uniform(0.1, 0.3)))
            row = top + int(rng.integers(wing, max(wing + 1, height - wing - gate)))
            fill_rectangle(occupied, row, left if chance(rng, 0.5) else left + width - wing, gate, wing, value=False)


def _block(rng: np.random.Generator, occupied: np.ndarray, rows: Span, cols: Span, lot: float) -> None:
    """One block: a single building, or lots with alleys between some of them."""
    (top, bottom), (left, right) = rows, cols
    if max(bottom - top, right - left) < 2 * lot or chance(rng, 0.35):
        _building(rng, occupied, top, left, bottom - top, right - left)
        return
    alley = max(3, int(lot * 0.2)) if chance(rng, 0.6) else 0
    upright = right - left > bottom - top
    length = right - left if upright else bottom - top
    count = max(2, int(length / max(lot, 8.0)))
    edges = np.linspace(0, length, count + 1).astype(int)
    for start, end in zip(edges[:-1].tolist(), edges[1:].tolist()):
        size = end - start - (alley if end < length else 0)
        if chance(rng, 0.06) or size < 3:
            continue
        if upright:
            _building(rng, occupied, top, left + start, max(3, int((bottom - top) * rng.uniform(0.75, 1.0))), size)
        else:
            _building(rng, occupied, top + start, left, size, max(3, int((right - left) * rng.uniform(0.75, 1.0))))


def city(rng: np.random.Generator, side: int) -> np.ndarray:
    """Buildings between streets of varied width; merged blocks, squares, a diagonal avenue."""
    shape = random_shape(rng, side)
    occupied = np.zeros(shape, dtype=bool)
    street = max(3.0, log_uniform(rng, side / 64, side / 16))
    block = max(2 * street, log_uniform(rng, side / 12, side / 4))
    variety = rng.uniform(0.0, 0.5)
    rows, cols = (_lines(rng, n, block, street, variety) for n in shape)
    lot = block * rng.uniform(0.3, 0.8)
    merged, empty = rng.uniform(0.0, 0.3), rng.uniform(0.0, 0.12)
    for i, row in enumerate(rows):
        for j, col in enumerate(cols):
            if chance(rng, empty):
                continue
            _block(rng, occupied, row, col, lot)
            if chance(rng, merged):  # no street to the next block
                if chance(rng, 0.5) and i + 1 < len(rows):
                    fill_rectangle(occupied, row[1], col[0], rows[i + 1][0] - row[1], col[1] - col[0])
                elif j + 1 < len(cols):
                    fill_rectangle(occupied, row[0], col[1], row[1] - row[0], cols[j + 1][0] - col[1])
    for _ in range(rng.integers(1, 3) if chance(rng, 0.35) else 0):
        angle = rng.uniform(0, math.pi)
        reach = np.array([math.sin(angle), math.cos(angle)]) * 1.5 * side
        centre = rng.uniform(0.25, 0.75, 2) * shape
        stroke(occupied, np.stack((centre - reach, centre + reach)), max(4, round(1.3 * street)), value=False)
    if chance(rng, 0.3):
        frame(occupied, int(rng.integers(1, 4)))
    return occupied
