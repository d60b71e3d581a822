# SPDX-License-Identifier: BSD-3-Clause
"""Draws the maps of bench/maps/, which the suite ``peers`` plans on: a few of each kind, 256 pixels a side.

python bench/make_maps.py       (needs the training package)
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

from lrrt_training import families

FOLDER = Path(__file__).parent / "maps"
KINDS = ("rooms", "office", "automata_caves", "city", "bug_traps", "narrow_gaps")
COUNT, SIDE, SEED = 4, 256, 2026


def main() -> None:
    for number, kind in enumerate(KINDS):
        folder = FOLDER / kind
        folder.mkdir(parents=True, exist_ok=True)
        for k in range(COUNT):
            occupied = families.random_map(np.random.default_rng([SEED, number, k]), kind, SIDE)
            Image.fromarray(~occupied).save(folder / f"{k}.png", optimize=True)


if __name__ == "__main__":
    main()
