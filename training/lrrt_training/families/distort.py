# SPDX-License-Identifier: BSD-3-Clause
"""What happens to maps between a drawing and a robot: turns, ragged walls, noise, unknown surroundings, outlines."""

from __future__ import annotations

import math

import numpy as np
from scipy import ndimage

from lrrt_training.families.draw import (
    chance,
    disc_offsets,
    eroded,
    log_uniform,
    smooth_noise,
    square_offsets,
    stamp,
)

_RING = ((0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0), (1, 1))  # neighbours, one after the other
PROBABILITIES = {"rotate": 0.3, "ragged": 0.35, "unknown": 0.15, "enclose": 0.1, "outline": 0.12, "salt": 0.25}


def _flip(rng: np.random.Generator, occupied: np.ndarray) -> np.ndarray:
    """One of the symmetries that keep the shape."""
    if chance(rng, 0.5):
        occupied = occupied[::-1]
    if chance(rng, 0.5):
        occupied = occupied[:, ::-1]
    if occupied.shape[0] == occupied.shape[1] and chance(rng, 0.5):
        occupied = occupied.T
    return np.ascontiguousarray(occupied)


def _close_corners(occupied: np.ndarray) -> None:
    """Occupies one pixel wherever two occupied ones touch at a corner only, so that thin slanted walls are tight."""
    one, other = occupied[:-1, :-1], occupied[1:, 1:]
    right, left = occupied[:-1, 1:], occupied[1:, :-1]
    falling, rising = one & other & ~right & ~left, right & left & ~one & ~other
    right |= falling
    one |= rising


def _rotate(rng: np.random.Generator, occupied: np.ndarray) -> np.ndarray:
    """Turned by any angle about its centre and enlarged a little (never reduced: walls would vanish)."""
    height, width = occupied.shape
    angle, step = rng.uniform(0, 2 * math.pi), rng.uniform(0.8, 1.0)
    if chance(rng, 0.4):  # slightly askew only
        angle = rng.uniform(-0.2, 0.2)
    padded = np.pad(occupied, 1, constant_values=chance(rng, 0.6))
    cosine, sine = np.float32(step * math.cos(angle)), np.float32(step * math.sin(angle))
    rows = np.arange(height, dtype=np.float32)[:, None] - np.float32((height - 1) / 2)
    cols = np.arange(width, dtype=np.float32) - np.float32((width - 1) / 2)
    from_row = (rows * cosine - cols * sine + np.float32((height - 1) / 2 + 1.5)).astype(np.int32)
    from_col = (rows * sine + cols * cosine + np.float32((width - 1) / 2 + 1.5)).astype(np.int32)
    np.clip(from_row, 0, height + 1, out=from_row)
    np.clip(from_col, 0, width + 1, out=from_col)
    turned = padded.ravel()[from_row * np.int32(width + 2) + from_col]
    _close_corners(turned)
    return turned


def _ragged(rng: np.random.Generator, occupied: np.ndarray) -> np.ndarray:
    """Moves pixels at the boundary between free and occupied without opening, closing, joining or parting anything.

    A pixel may change if exactly one 4-connected free part of its eight neighbours touches it (a *simple* point).
    Pixels of the same parity of row and column change together: none of them are neighbours.
    """
    height, width = occupied.shape
    share = rng.uniform(0.05, 0.35)
    free = np.pad(~occupied, 1).view(np.uint8)
    for _ in range(rng.choice((1, 1, 2, 3))):
        if chance(rng, 0.5):
            change = rng.random(occupied.shape, dtype=np.float32) < share
        else:
            change = smooth_noise(rng, occupied.shape, rng.uniform(2.0, 8.0)) > 1.3 - 2 * share
        for row, col in ((0, 0), (1, 1), (0, 1), (1, 0)):
            around = [free[1 + row + dr : height + 1 + dr : 2, 1 + col + dc : width + 1 + dc : 2] for dr, dc in _RING]
            parts = sum(around[k] & ~(around[k + 1] & around[(k + 2) % 8]) for k in (0, 2, 4, 6))
            free[1 + row : height + 1 : 2, 1 + col : width + 1 : 2] ^= (parts == 1) & change[row::2, col::2]
    return free[1:-1, 1:-1] == 0


def _unknown(rng: np.random.Generator, occupied: np.ndarray) -> np.ndarray:
    """Occupies everything outside an irregular blob."""
    height, width = occupied.shape
    rows = np.linspace(-1, 1, height, dtype=np.float32)[:, None] - np.float32(rng.uniform(-0.15, 0.15))
    cols = np.linspace(-1, 1, width, dtype=np.float32) - np.float32(rng.uniform(-0.15, 0.15))
    power = 2 if chance(rng, 0.5) else 6
    field = rows**power + cols**power
    for period, weight in ((0.35, 0.3), (0.08, 0.08)):
        field = field + smooth_noise(rng, occupied.shape, period * max(height, width)) * np.float32(weight)
    return occupied | (field > rng.uniform(0.7, 1.1))


def _enclose(occupied: np.ndarray) -> np.ndarray:
    """Occupies all that cannot be reached from the largest free part."""
    labels, count = ndimage.label(~occupied)
    if count < 2:
        return occupied
    return labels != 1 + np.bincount(labels.ravel())[1:].argmax()


def _outline(rng: np.random.Generator, occupied: np.ndarray) -> np.ndarray:
    """Keeps the outer one to three pixels of obstacles; what is behind becomes free but out of reach."""
    inner = occupied
    for _ in range(rng.integers(1, 4)):
        inner = eroded(inner)
    return occupied & ~inner


def _salt(rng: np.random.Generator, occupied: np.ndarray) -> np.ndarray:
    """Occupied pixels and specks that a scanner imagines; rarely, a hole in a wall."""
    noisy = occupied.copy()
    count = int(log_uniform(rng, 0.0003, 0.012) * occupied.size) + 1
    places = rng.random((count, 2)) * occupied.shape - 0.5
    specks = count // int(rng.integers(3, 20))
    stamp(noisy, places[specks:], square_offsets(1))
    if chance(rng, 0.5):
        stamp(noisy, places[:specks], disc_offsets(int(rng.integers(2, 5))))
    if chance(rng, 0.1):
        stamp(noisy, rng.random((max(1, count // 8), 2)) * occupied.shape - 0.5, square_offsets(1), value=False)
    return noisy


def distort(rng: np.random.Generator, occupied: np.ndarray) -> np.ndarray:
    """A map of the same shape after a random choice of distortions; never empty, never full."""
    original = occupied
    wanted = {name: chance(rng, probability) for name, probability in PROBABILITIES.items()}
    occupied = _flip(rng, occupied)
    if wanted["rotate"]:
        occupied = _rotate(rng, occupied)
    if wanted["ragged"]:
        occupied = _ragged(rng, occupied)
    if wanted["unknown"]:
        occupied = _unknown(rng, occupied)
    if wanted["enclose"]:
        occupied = _enclose(occupied)
    if wanted["outline"]:
        occupied = _outline(rng, occupied)
    if wanted["salt"]:
        occupied = _salt(rng, occupied)
    if occupied.any() != occupied.all():
        return occupied
    occupied = original.copy()
    if occupied.all() or not occupied.any():
        occupied.flat[occupied.size // 2] ^= True
    return occupied
