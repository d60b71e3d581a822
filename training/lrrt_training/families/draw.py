# SPDX-License-Identifier: BSD-3-Clause
"""Drawing on bool maps: shapes go into small slices, strokes are scattered stamps, noise is a product of matrices.

Coordinates are (row, column) in pixels. Whatever lies outside the map is cut off.
"""

from __future__ import annotations

import math

import numpy as np

Shape = tuple[int, int]

LARGEST_ASPECT = 2.5


def random_shape(rng: np.random.Generator, side: int, square_share: float = 0.5) -> Shape:
    """(H, W) whose longer side is ``side``."""
    if rng.random() < square_share:
        return side, side
    short = max(math.ceil(side / LARGEST_ASPECT), int(side * rng.uniform(1 / LARGEST_ASPECT, 1.0)))
    return (short, side) if rng.random() < 0.5 else (side, short)


def chance(rng: np.random.Generator, probability: float) -> bool:
    """True with the given probability."""
    return bool(rng.random() < probability)


def log_uniform(rng: np.random.Generator, low: float, high: float) -> float:
    """Random number whose logarithm is uniform between those of low and high."""
    return float(math.exp(rng.uniform(math.log(low), math.log(max(low, high)))))


def widths(rng: np.random.Generator, total: int, count: int, low: int, spread: float) -> np.ndarray:
    """``count`` integers of at least ``low`` that sum to ``total``; spread 0 makes them (nearly) equal.

    Where count * low is more than total, low gives way.
    """
    low = min(low, total // count)
    shares = rng.uniform(1.0 - spread, 1.0 + spread, count)
    edges = np.rint(np.concatenate(([0.0], shares.cumsum() / shares.sum())) * (total - low * count))
    return low + np.diff(edges).astype(np.int64)


def frame(occupied: np.ndarray, thickness: int) -> None:
    """Walls along the map's border."""
    occupied[:thickness] = occupied[-thickness:] = True
    occupied[:, :thickness] = occupied[:, -thickness:] = True


def fill_rectangle(occupied: np.ndarray, top: float, left: float, height: float, width: float, value=True) -> None:
    """Upright rectangle."""
    rows = slice(max(0, round(top)), max(0, round(top + height)))
    occupied[rows, max(0, round(left)) : max(0, round(left + width))] = value


def _window(occupied: np.ndarray, centre, reach: tuple[float, float]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The part of the map around a centre, with its row (N, 1) and column (M,) coordinates relative to the centre."""
    low = [max(0, math.floor(c - r)) for c, r in zip(centre, reach)]
    high = [max(0, math.ceil(c + r) + 1) for c, r in zip(centre, reach)]
    part = occupied[low[0] : high[0], low[1] : high[1]]
    rows = np.arange(low[0], low[0] + part.shape[0])[:, None] - centre[0]
    return part, rows, np.arange(low[1], low[1] + part.shape[1]) - centre[1]


def fill_box(occupied: np.ndarray, centre, half: tuple[float, float], angle: float, value=True) -> None:
    """Rectangle of the given half sides, turned by an angle."""
    cosine, sine = math.cos(angle), math.sin(angle)
    reach = (
        abs(half[0] * cosine) + abs(half[1] * sine),
        abs(half[0] * sine) + abs(half[1] * cosine),
    )
    part, rows, cols = _window(occupied, centre, reach)
    part[(abs(rows * cosine + cols * sine) <= half[0]) & (abs(cols * cosine - rows * sine) <= half[1])] = value


def fill_disc(occupied: np.ndarray, centre, radius: float, value=True) -> None:
    """Disc."""
    part, rows, cols = _window(occupied, centre, (radius, radius))
    part[rows**2 + cols**2 <= radius**2] = value


def disc_offsets(diameter: int) -> np.ndarray:
    """(N, 2) offsets of the pixels of a disc; a square below a diameter of 4, so that thin strokes do not leak."""
    axis = np.arange(diameter) - (diameter - 1) // 2
    offsets = np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1).reshape(-1, 2)
    if diameter < 4:
        return offsets
    centred = offsets - (0.0 if diameter % 2 else 0.5)
    return offsets[(centred**2).sum(axis=1) <= (diameter / 2) ** 2 + 0.25]


def square_offsets(side: int) -> np.ndarray:
    """(N, 2) offsets of the pixels of a square."""
    axis = np.arange(side) - (side - 1) // 2
    return np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1).reshape(-1, 2)


def stamp(occupied: np.ndarray, points: np.ndarray, offsets: np.ndarray, value=True) -> None:
    """The same small pattern around each of (N, 2) points."""
    centres = np.rint(points).astype(np.int64)
    rows = (centres[:, :1] + offsets[:, 0]).ravel()
    cols = (centres[:, 1:] + offsets[:, 1]).ravel()
    inside = (rows >= 0) & (rows < occupied.shape[0]) & (cols >= 0) & (cols < occupied.shape[1])
    occupied[rows[inside], cols[inside]] = value


def stroke(occupied: np.ndarray, corners: np.ndarray, thickness: int, value=True) -> None:
    """A line along (N, 2) corners. From a thickness of 2 on it is 4-connected at any angle, so nothing leaks."""
    corners = np.asarray(corners, dtype=float)
    lengths = np.hypot(*np.diff(corners, axis=0).T)
    along = np.concatenate(([0.0], lengths.cumsum()))
    step = max(0.9, thickness / 5)  # less than a pixel: rounded points touch
    at = np.linspace(0.0, along[-1], 2 + int(along[-1] / step))
    points = np.stack((np.interp(at, along, corners[:, 0]), np.interp(at, along, corners[:, 1])), axis=1)
    stamp(occupied, points, disc_offsets(thickness), value)


def _interpolation(length: int, cells: int) -> np.ndarray:
    """(length, cells + 1) smooth weights of the knots for every pixel."""
    at = (np.arange(length, dtype=np.float32) + 0.5) * (cells / length)
    knot = at.astype(np.int64)
    part = at - knot
    part = part * part * (3 - 2 * part)
    weights = np.zeros((length, cells + 1), dtype=np.float32)
    index = np.arange(length)
    weights[index, knot] = 1 - part
    weights[index, knot + 1] = part
    return weights


def smooth_noise(rng: np.random.Generator, shape: Shape, period: float) -> np.ndarray:
    """(H, W) float32 noise about 0 with a deviation of about 1 that changes over about ``period`` pixels."""
    cells = [max(1, round(n / period)) for n in shape]
    knots = rng.standard_normal((cells[0] + 1, cells[1] + 1), dtype=np.float32)
    return _interpolation(shape[0], cells[0]) @ knots @ _interpolation(shape[1], cells[1]).T * np.float32(1.35)


def eroded(mask: np.ndarray, border: bool = True) -> np.ndarray:
    """Pixels whose 3×3 neighbourhood is all set; ``border`` is the value outside the map."""
    padded = np.pad(mask, 1, constant_values=border)
    rows = padded[:-2] & padded[1:-1] & padded[2:]
    return rows[:, :-2] & rows[:, 1:-1] & rows[:, 2:]
