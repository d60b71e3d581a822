# SPDX-License-Identifier: BSD-3-Clause
"""Draws the project's sample map, python/lrrt/data/maze35.png: a maze of 35×35 blocks with 7×7 pixels each.

A depth-first search with random turns carves a perfect maze; then a few inner walls are opened, so that there is
more than one way. Run it again only to change the map: ``python examples/make_sample_map.py``.
"""

from __future__ import annotations

import random
from pathlib import Path

import numpy as np
from PIL import Image

BLOCKS = 35  # odd: cells lie on odd rows and columns, walls between them
PIXELS_PER_BLOCK = 7
OPENED_WALLS = 12
SEED = 3
TARGET = Path(__file__).resolve().parents[1] / "python" / "lrrt" / "data" / "maze35.png"


def carve(choose: random.Random) -> np.ndarray:
    """(BLOCKS, BLOCKS) bool, True = free."""
    free = np.zeros((BLOCKS, BLOCKS), dtype=bool)
    free[1, 1] = True
    stack = [(1, 1)]
    while stack:
        row, col = stack[-1]
        steps = [
            (dr, dc)
            for dr, dc in ((-1, 0), (1, 0), (0, -1), (0, 1))
            if 0 < row + 2 * dr < BLOCKS and 0 < col + 2 * dc < BLOCKS and not free[row + 2 * dr, col + 2 * dc]
        ]
        if not steps:
            stack.pop()
            continue
        dr, dc = choose.choice(steps)
        free[row + dr, col + dc] = free[row + 2 * dr, col + 2 * dc] = True
        stack.append((row + 2 * dr, col + 2 * dc))
    return free


def open_walls(free: np.ndarray, choose: random.Random) -> None:
    """Opens walls that part two corridors; each makes a loop."""
    walls = [
        (row, col)
        for row in range(1, BLOCKS - 1)
        for col in range(1, BLOCKS - 1)
        if not free[row, col] and (row + col) % 2 == 1  # between two cells
    ]
    for row, col in choose.sample(walls, OPENED_WALLS):
        free[row, col] = True


def main() -> None:
    choose = random.Random(SEED)
    free = carve(choose)
    open_walls(free, choose)
    pixels = np.kron(free, np.ones((PIXELS_PER_BLOCK, PIXELS_PER_BLOCK), dtype=bool))
    TARGET.parent.mkdir(parents=True, exist_ok=True)
    Image.fromarray(pixels).convert("1").save(TARGET, optimize=True)
    print(f"wrote {TARGET}")


if __name__ == "__main__":
    main()
