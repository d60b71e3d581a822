# SPDX-License-Identifier: BSD-3-Clause
"""Families of random maps: what planners meet besides mazes of blocks."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy import ndimage

from lrrt_training.families.caves import automata_caves, noise_caves, tunnels
from lrrt_training.families.city import city
from lrrt_training.families.corridors import corridor_maze
from lrrt_training.families.distort import distort
from lrrt_training.families.obstacles import bug_traps, forest, narrow_gaps, scattered_shapes
from lrrt_training.families.rooms import office, rooms

LEAST_FREE = 0.05
LEAST_CONNECTED = 0.03
_MOST_ATTEMPTS = 1000

FAMILIES: dict[str, Callable[[np.random.Generator, int], np.ndarray]] = {
    "corridor_maze": corridor_maze,
    "rooms": rooms,
    "office": office,
    "scattered_shapes": scattered_shapes,
    "forest": forest,
    "bug_traps": bug_traps,
    "narrow_gaps": narrow_gaps,
    "automata_caves": automata_caves,
    "noise_caves": noise_caves,
    "tunnels": tunnels,
    "city": city,
}


def is_usable(occupied: np.ndarray) -> bool:
    """Whether a map has enough free pixels, and enough of them 4-connected with each other."""
    free = ~occupied
    if free.mean() < LEAST_FREE or free.all():
        return False
    labels, _ = ndimage.label(free)
    return bool(np.bincount(labels.ravel())[1:].max() >= LEAST_CONNECTED * free.size)


def random_map(rng: np.random.Generator, family: str, side: int) -> np.ndarray:
    """A distorted map of a family as an (H, W) bool array, True = occupied, whose longer side is ``side``.

    At least 5 % of its pixels are free, and the largest 4-connected free part has at least 3 % of all pixels.
    """
    if family not in FAMILIES:
        raise ValueError(f"map family {family!r}: expected one of {', '.join(FAMILIES)}")
    for _ in range(_MOST_ATTEMPTS):
        occupied = distort(rng, FAMILIES[family](rng, side))
        if is_usable(occupied):
            return occupied
    raise RuntimeError(f"map family {family!r}: no usable map of side {side} in {_MOST_ATTEMPTS} attempts")
