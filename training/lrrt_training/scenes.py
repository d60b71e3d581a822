# SPDX-License-Identifier: BSD-3-Clause
"""Planning problems: a map, a start, a goal, and where the path between them runs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from scipy import ndimage

import lrrt

from . import families, mazes
from .families.external import ExternalMaps
from .metrics import PROMISING
from .store import MazeStore, unpack

SMALLEST_BLOCK = 3.0  #: least size of a maze's block in the network's input, in pixels
LARGEST_SHRINK = 1.5  #: how far a maze's picture may exceed the input
RADIUS = 5.0  #: half the width of the promising region in maps without blocks, pixels of the network's input
CLEARANCE = 6.0  #: nearer than this to an obstacle the true path avoids to run, pixels of the network's input
_SHARE_OF_FAR_PAIRS = 0.7
_FAR_PAIR_CANDIDATES = 8

Point = tuple[float, float]


class Scene(Protocol):
    """A planning problem."""

    group: str  #: maze level or family, under which it is counted
    start: Point  #: (x, y) in map pixels
    goal: Point

    def occupancy_map(self) -> lrrt.OccupancyMap: ...

    def label(self, scale: float) -> np.ndarray:
        """(H, W) uint8 classes 0 free, 1 obstacle, 2 promising; ``scale`` is input pixels per map pixel."""


@dataclass(frozen=True)
class MazeScene:
    """A problem on a maze of blocks; the blocks of the shortest path are promising."""

    blocks: np.ndarray  #: (m, m) bool, True = occupied
    path: np.ndarray  #: (m, m) bool, the blocks of the shortest path
    scale: int  #: map pixels per block
    start: Point
    goal: Point

    @property
    def group(self) -> str:
        return str(len(self.blocks))

    @property
    def looped(self) -> bool:
        """Whether some blocks are joined by more than one way."""
        free = ~self.blocks
        passages = (free[1:] & free[:-1]).sum() + (free[:, 1:] & free[:, :-1]).sum()
        return bool(passages >= free.sum())

    def enlarge(self, blocks: np.ndarray) -> np.ndarray:
        """A picture at block resolution → at map resolution."""
        return np.kron(blocks, np.ones((self.scale, self.scale), dtype=blocks.dtype)) if self.scale > 1 else blocks

    def occupancy_map(self) -> lrrt.OccupancyMap:
        return lrrt.OccupancyMap.from_array(np.ascontiguousarray(self.enlarge(self.blocks)))

    def label(self, scale: float) -> np.ndarray:
        return self.enlarge(np.where(self.path, PROMISING, self.blocks.astype(np.uint8)).astype(np.uint8))


@dataclass(frozen=True)
class MapScene:
    """A problem on any other map; the cheapest path, widened by RADIUS within free space, is promising."""

    occupied: np.ndarray  #: (H, W) bool
    start: Point
    goal: Point
    group: str

    def occupancy_map(self) -> lrrt.OccupancyMap:
        return lrrt.OccupancyMap.from_array(self.occupied)

    def label(self, scale: float) -> np.ndarray:
        grid = self.occupancy_map()
        path = lrrt.shortest_path(grid, self.start, self.goal, clearance=CLEARANCE / scale, smooth=True)
        promising = lrrt.widened(grid, path, RADIUS / scale)
        return np.where(promising, PROMISING, self.occupied.astype(np.uint8)).astype(np.uint8)


def possible_scales(level: int, size: int) -> list[int]:
    """Map pixels per block (at least 2) for which blocks keep SMALLEST_BLOCK pixels of an input of side ``size``."""
    scales = []
    for scale in range(2, 2 * size // level + 1):
        crop = (level - 2) * scale + 2  # the encoder keeps one pixel of the border wall
        zoom = size // crop if crop <= size else size / crop
        if crop <= LARGEST_SHRINK * size and scale * zoom >= SMALLEST_BLOCK:
            scales.append(scale)
    return scales


def path_blocks(blocks: np.ndarray, start: tuple[int, int], goal: tuple[int, int]) -> np.ndarray:
    """(m, m) bool, the blocks of the shortest path between two blocks given as (row, column)."""
    centres = [(float(column) + 0.5, float(row) + 0.5) for row, column in (start, goal)]
    points = lrrt.shortest_path(lrrt.OccupancyMap.from_array(blocks), *centres)
    columns, rows = np.floor(np.asarray(points)).astype(int).T
    path = np.zeros(blocks.shape, dtype=bool)
    path[rows, columns] = True
    return path


def _position(rng: np.random.Generator, block: tuple[int, int], scale: int) -> Point:
    """The centre of a random map pixel of the block (row, column), as (x, y)."""
    row, column = (int(b) * scale + int(rng.integers(scale)) for b in block)
    return column + 0.5, row + 0.5


def _turned(rng: np.random.Generator, picture: np.ndarray) -> np.ndarray:
    """One of the 8 symmetries of a picture."""
    picture = np.rot90(picture, int(rng.integers(4)))
    return np.ascontiguousarray(picture.T if rng.integers(2) else picture)


def random_maze_scene(rng: np.random.Generator, blocks: np.ndarray, size: int, pixel_share: float) -> MazeScene:
    """The maze in one of its symmetries, with random start and goal and the shortest path between them.

    Args:
        rng: source of all randomness.
        blocks: (m, m) bool, True = occupied.
        size: side of the network's input.
        pixel_share: probability that the map has several pixels a block instead of one.
    """
    scales = possible_scales(len(blocks), size)
    scale = int(rng.choice(scales)) if scales and rng.random() < pixel_share else 1
    blocks = _turned(rng, blocks)
    start, goal = mazes.random_ends(rng, blocks)
    return MazeScene(
        blocks=blocks,
        path=path_blocks(blocks, start, goal),
        scale=scale,
        start=_position(rng, start, scale),
        goal=_position(rng, goal, scale),
    )


def random_ends(rng: np.random.Generator, occupied: np.ndarray) -> tuple[Point, Point]:
    """Centres (x, y) of two different pixels of the largest free component.

    Seven pairs in ten are the farthest (straight-line) of eight random pairs, the others are arbitrary.
    """
    labels, count = ndimage.label(~occupied)
    if count == 0:
        raise ValueError("the map has no free pixel")
    sizes = np.bincount(labels.ravel())
    sizes[0] = 0
    pixels = np.flatnonzero(labels == np.argmax(sizes))
    if len(pixels) < 2:
        raise ValueError("the map has no two free pixels that touch")
    candidates = _FAR_PAIR_CANDIDATES if rng.random() < _SHARE_OF_FAR_PAIRS else 1
    first = rng.integers(len(pixels), size=candidates)
    other = (first + rng.integers(1, len(pixels), size=candidates)) % len(pixels)
    rows, columns = np.divmod(pixels, occupied.shape[1])
    apart = (rows[first] - rows[other]) ** 2 + (columns[first] - columns[other]) ** 2
    best = np.argmax(apart)
    start, goal = ((float(columns[i]) + 0.5, float(rows[i]) + 0.5) for i in (first[best], other[best]))
    return start, goal


def random_map_scene(rng: np.random.Generator, occupied: np.ndarray, group: str) -> MapScene:
    """The map in one of its symmetries with random start and goal."""
    occupied = _turned(rng, occupied)
    start, goal = random_ends(rng, occupied)
    return MapScene(occupied, start, goal, group)


class SceneSource:
    """Scenes by group: maze levels from a store, families from their generators, external maps from a folder.

    Args:
        store: the mazes.
        external: maps of other sources.
        split: "train", "evaluation" or "test". Families are generated; the split only changes the seeds.
    """

    def __init__(self, store: MazeStore, external: ExternalMaps, split: str) -> None:
        self.store, self.external, self.split = store, external, split

    def maze(
        self,
        rng: np.random.Generator,
        level: int,
        size: int,
        pixel_share: float,
        number: int = -1,
        braided_share: float = 0.0,
    ) -> MazeScene:
        """A maze of a level: a random one, or that of a number (counted round); with probability ``braided_share`` a
        random part of its dead ends is opened."""
        stored = self.store.mazes(self.split, level)
        number = int(rng.integers(len(stored))) if number < 0 else number % len(stored)
        blocks = unpack(stored[number], level)
        if braided_share > 0:  # without a share nothing is drawn, so that the numbers that follow stay the same
            blocks = mazes.sometimes_braided(rng, blocks, braided_share)
        return random_maze_scene(rng, blocks, size, pixel_share)

    def family(self, rng: np.random.Generator, family: str, size: int) -> MapScene:
        """A map of a family; its longer side is 0.4 to 1.6 times the network's input."""
        side = max(64, int(size * np.exp(rng.uniform(np.log(0.4), np.log(1.6)))))
        return random_map_scene(rng, families.random_map(rng, family, side), family)

    def outside(self, rng: np.random.Generator, name: str, number: int = -1) -> MapScene:
        """A map of an external set: a random one, or that of a number (counted round)."""
        count = self.external.count(name, self.split)
        number = int(rng.integers(count)) if number < 0 else number % count
        return random_map_scene(rng, self.external.map(name, self.split, number), name)

    def groups(self, levels: list[int], size: int, pixel_share: float = 0.5) -> dict[str, Callable[..., Scene]]:
        """Every group with the function (rng, number) that makes its scenes."""
        made: dict[str, Callable[..., Scene]] = {}
        for level in levels:
            made[str(level)] = lambda rng, number, m=level: self.maze(rng, m, size, pixel_share, number)
        for family in families.FAMILIES:
            made[family] = lambda rng, number, f=family: self.family(rng, f, size)
        for name in self.external.names():
            made[name] = lambda rng, number, n=name: self.outside(rng, n, number)
        return made
