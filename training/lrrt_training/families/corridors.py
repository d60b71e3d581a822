# SPDX-License-Identifier: BSD-3-Clause
"""Mazes in pixels, whose walls and corridors have widths of their own."""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from lrrt_training.families.draw import chance, log_uniform, random_shape, widths
from lrrt_training.mazes import random_maze

NARROWEST_CORRIDOR = 3
LARGEST_LEVEL = 49


def _joined(rng: np.random.Generator, blocks: np.ndarray) -> np.ndarray:
    """Opens inner walls of a block map until all its cells are connected."""
    labels, count = ndimage.label(~blocks)
    if count <= 1:
        return blocks
    group = np.arange(count + 1)
    rows, cols = np.nonzero(blocks[1:-1, 1:-1])
    walls = np.stack((rows, cols), axis=1)[(rows + cols) % 2 == 1] + 1  # between two cells, not at a corner of four
    for row, col in walls[rng.permutation(len(walls))].tolist():
        dr = 1 if row % 2 == 0 else 0
        one, other = group[labels[row - dr, col - 1 + dr]], group[labels[row + dr, col + 1 - dr]]
        if one != other:
            blocks[row, col] = False
            group[group == other] = one
    return blocks


def rectangular_maze(rng: np.random.Generator, rows: int, cols: int, braided_share: float) -> np.ndarray:
    """Block map (2 rows + 1, 2 cols + 1) of a maze: part of a square maze, connected anew."""
    square = random_maze(rng, max(5, 2 * max(rows, cols) + 1), braided_share)
    blocks = square[: 2 * rows + 1, : 2 * cols + 1].copy()
    blocks[-1] = blocks[:, -1] = True
    return _joined(rng, blocks)


def _open_places(rng: np.random.Generator, blocks: np.ndarray) -> None:
    """Turns some rectangles of cells into halls, each up to a third of the map wide."""
    for _ in range(rng.integers(1, 4)):
        height, width = 2 * rng.integers(1, 4, size=2) + 1
        if 3 * height < blocks.shape[0] and 3 * width < blocks.shape[1]:
            top = 1 + 2 * rng.integers((blocks.shape[0] - height) // 2)
            left = 1 + 2 * rng.integers((blocks.shape[1] - width) // 2)
            blocks[top : top + height, left : left + width] = False


def _block_widths(rng: np.random.Generator, pixels: int, cells: int, wall: int, wide_walls: bool, spread: float):
    """Pixels of every row (or column) of blocks, walls and corridors in turn, which sum to ``pixels``."""
    result = np.empty(2 * cells + 1, dtype=np.int64)
    if wide_walls:
        corridor = max(NARROWEST_CORRIDOR, int(pixels / cells * rng.uniform(0.2, 0.5)))
        result[1::2] = corridor
        result[::2] = widths(rng, pixels - corridor * cells, cells + 1, 1, spread)
    else:
        result[::2] = wall
        result[1::2] = widths(rng, pixels - wall * (cells + 1), cells, NARROWEST_CORRIDOR, spread)
    return result


def corridor_maze(rng: np.random.Generator, side: int) -> np.ndarray:
    """A maze, perfect or with loops, whose walls are thinner or thicker than its corridors."""
    shape = random_shape(rng, side)
    wall = int(rng.integers(1, 4)) if chance(rng, 0.7) else int(rng.integers(2, max(3, side // 40)))
    wide_walls = chance(rng, 0.25)
    least = (2 if wide_walls else 1) * NARROWEST_CORRIDOR + wall + 1
    pitch = log_uniform(rng, max(least, side / 24), side / 6)
    squeeze = log_uniform(rng, 0.6, 1.6) if chance(rng, 0.4) else 1.0
    most = (LARGEST_LEVEL - 1) // 2
    wanted = (shape[0] / pitch * squeeze, shape[1] / pitch / squeeze)
    rows, cols = (min(most, max(2, min(int(n), (s - wall) // least))) for n, s in zip(wanted, shape))
    blocks = rectangular_maze(rng, rows, cols, 0.4)
    if chance(rng, 0.25):
        _open_places(rng, blocks)
    spread = rng.uniform(0.0, 0.7) if chance(rng, 0.6) else 0.0
    heights = _block_widths(rng, shape[0], rows, wall, wide_walls, spread)
    lengths = _block_widths(rng, shape[1], cols, wall, wide_walls, spread)
    return blocks.repeat(heights, axis=0).repeat(lengths, axis=1)
