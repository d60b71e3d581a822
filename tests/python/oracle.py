# SPDX-License-Identifier: BSD-3-Clause
"""Independent judges of paths and maps. They share no code with the library: NumPy and first principles only."""

from __future__ import annotations

from collections import deque

import numpy as np

_SAMPLES_PER_PIXEL = 64
_SLIVER = 1e-9  # shorter pieces of a segment cannot be told from rounding


def first_collision(free: np.ndarray, path: np.ndarray) -> tuple[float, float] | None:
    """A point of the path that is not on a free pixel, or None.

    Two methods, and both must agree that the path is free: dense samples, and the exact pieces of every segment
    between its crossings with the pixel grid.

    Args:
        free: (H, W) bool.
        path: (N, 2) pixel coordinates, x right, y down; pixel (c, r) covers [c, c+1) × [r, r+1).
    """
    for a, b in zip(path[:-1], path[1:], strict=True):
        for points in (_dense_samples(a, b), _piece_centers(a, b), _corner_neighbours(a, b)):
            bad = ~_on_free(free, points)
            if bad.any():
                return tuple(points[np.argmax(bad)])
    return None


def _on_free(free: np.ndarray, points: np.ndarray) -> np.ndarray:
    height, width = free.shape
    columns, rows = np.floor(points).astype(np.int64).T
    inside = (columns >= 0) & (columns < width) & (rows >= 0) & (rows < height)
    result = np.zeros(len(points), dtype=bool)
    result[inside] = free[rows[inside], columns[inside]]
    return result


def _dense_samples(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    count = max(2, int(np.ceil(np.linalg.norm(b - a) * _SAMPLES_PER_PIXEL)) + 1)
    t = np.linspace(0.0, 1.0, count)[:, None]
    return a * (1.0 - t) + b * t


def _crossings(a: float, b: float) -> tuple[np.ndarray, np.ndarray]:
    """Grid lines strictly between two coordinates, and where on the way from a to b they are met."""
    low, high = min(a, b), max(a, b)
    lines = np.arange(np.floor(low) + 1.0, np.ceil(high))
    return lines, (lines - a) / (b - a) if len(lines) else lines


def _piece_centers(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    t = np.unique(np.concatenate(([0.0, 1.0], _crossings(a[0], b[0])[1], _crossings(a[1], b[1])[1])))
    keep = np.diff(t) * np.linalg.norm(b - a) > _SLIVER
    centers = ((t[:-1] + t[1:]) / 2.0)[keep][:, None]
    return a * (1.0 - centers) + b * centers


def _corner_neighbours(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Centres of the four pixels around every grid corner that the segment passes through exactly."""
    columns, tx = _crossings(a[0], b[0])
    rows, ty = _crossings(a[1], b[1])
    _, at_x, at_y = np.intersect1d(tx, ty, return_indices=True)
    corners = np.column_stack((columns[at_x], rows[at_y]))
    offsets = np.array([(-0.5, -0.5), (-0.5, 0.5), (0.5, -0.5), (0.5, 0.5)])
    return (corners[:, None, :] + offsets).reshape(-1, 2)


def length(path: np.ndarray) -> float:
    """Sum of the lengths of the segments."""
    return float(sum(np.hypot(*(b - a)) for a, b in zip(path[:-1], path[1:], strict=True)))


def reachable(free: np.ndarray, start: tuple[int, int]) -> np.ndarray:
    """(H, W) bool: the free pixels that a walk over edges (no diagonals) reaches from pixel (column, row)."""
    height, width = free.shape
    seen = np.zeros_like(free)
    column, row = start
    if not free[row, column]:
        return seen
    seen[row, column] = True
    queue = deque([(column, row)])
    while queue:
        c, r = queue.popleft()
        for x, y in ((c + 1, r), (c - 1, r), (c, r + 1), (c, r - 1)):
            if 0 <= x < width and 0 <= y < height and free[y, x] and not seen[y, x]:
                seen[y, x] = True
                queue.append((x, y))
    return seen
