# SPDX-License-Identifier: BSD-3-Clause
"""Training samples: a maze, a start and a goal become network input and label, by the library's own encoder."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import torch
from torch.utils.data import Dataset, Sampler

import lrrt

from . import mazes
from .metrics import GOAL, OBSTACLE, PROMISING, START
from .store import SPLITS, MazeStore, unpack

MARKER_SIDE = 5  #: least side of the start and goal markers, in pixels of the network's input
SMALLEST_BLOCK = 3.0  #: least size of a block in the network's input, in pixels
LARGEST_SHRINK = 1.5  #: how far a picture may exceed the input


@dataclass(frozen=True)
class Scene:
    """One planning problem on a map of blocks.

    ``scale`` is the number of map pixels per block; ``start`` and ``goal`` are (x, y) in map pixels.
    """

    blocks: np.ndarray  #: (m, m) bool, True = occupied
    path: np.ndarray  #: (m, m) bool, the blocks of the shortest path
    ends: np.ndarray  #: (m, m) uint8, START and GOAL on their blocks
    scale: int
    start: tuple[float, float]
    goal: tuple[float, float]

    def enlarge(self, blocks: np.ndarray) -> np.ndarray:
        """A picture at block resolution → at map resolution."""
        return np.kron(blocks, np.ones((self.scale, self.scale), dtype=blocks.dtype)) if self.scale > 1 else blocks

    def label(self) -> np.ndarray:
        """(m, m) uint8 classes: 0 free, 1 obstacle, 2 promising."""
        return np.where(self.path, PROMISING, self.blocks.astype(np.uint8)).astype(np.uint8)

    def occupancy_map(self) -> lrrt.OccupancyMap:
        return lrrt.OccupancyMap.from_array(np.ascontiguousarray(self.enlarge(self.blocks)))


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


def _position(rng: np.random.Generator, block: tuple[int, int], scale: int) -> tuple[float, float]:
    """The centre of a random map pixel of the block (row, column), as (x, y)."""
    row, column = (int(b) * scale + int(rng.integers(scale)) for b in block)
    return column + 0.5, row + 0.5


def random_scene(rng: np.random.Generator, blocks: np.ndarray, scale: int) -> Scene:
    """The maze in one of its 8 symmetries, with random start and goal and the shortest path between them."""
    blocks = np.rot90(blocks, int(rng.integers(4)))
    blocks = np.ascontiguousarray(blocks.T if rng.integers(2) else blocks)
    start, goal = mazes.random_ends(rng, blocks)
    ends = np.zeros(blocks.shape, dtype=np.uint8)
    ends[start], ends[goal] = START, GOAL
    return Scene(
        blocks=blocks,
        path=path_blocks(blocks, start, goal),
        ends=ends,
        scale=scale,
        start=_position(rng, start, scale),
        goal=_position(rng, goal, scale),
    )


class MazeDataset(Dataset):
    """Sample i is a function of (seed, split, i) alone.

    An item is a dict: ``image`` (3, S, S) uint8, ``label`` (S, S) uint8 classes, ``ends`` (S, S) uint8 with the
    blocks of start (1) and goal (2), ``level`` int. The level of every sample is drawn anew, so every batch mixes
    levels.

    Args:
        store: where the mazes come from.
        split: "train", "evaluation" or "test".
        levels: maze levels.
        size: side of the network's input.
        length: number of samples.
        seed: seed of the samples (the mazes have the store's).
        pixel_share: share of the samples whose map has several pixels a block; the others have one.
        in_turn: takes levels and mazes in turn instead of at random: ``length`` / len(levels) different mazes of each
            level.
    """

    def __init__(
        self,
        store: MazeStore,
        split: str,
        levels: list[int],
        size: int,
        length: int,
        seed: int = 1,
        pixel_share: float = 0.5,
        in_turn: bool = False,
    ) -> None:
        if split not in SPLITS:
            raise ValueError(f"split {split!r}: expected one of {', '.join(SPLITS)}")
        self.store, self.split, self.levels, self.length = store, split, list(levels), length
        self.seed, self.pixel_share, self.in_turn = seed, pixel_share, in_turn
        self.size = size
        self.encoder = lrrt.Encoder(size=size, marker_side=MARKER_SIDE)

    def __len__(self) -> int:
        return self.length

    def scene(self, index: int) -> Scene:
        """The planning problem of sample ``index``."""
        rng = np.random.default_rng([self.seed, SPLITS.index(self.split), index])
        level_draw, maze_draw = rng.random(2)
        if self.in_turn:
            level = self.levels[index % len(self.levels)]
            stored = self.store.mazes(self.split, level)
            maze = index // len(self.levels) % len(stored)
        else:
            level = self.levels[int(level_draw * len(self.levels))]
            stored = self.store.mazes(self.split, level)
            maze = int(maze_draw * len(stored))
        scales = possible_scales(level, self.size)
        scale = int(rng.choice(scales)) if scales and rng.random() < self.pixel_share else 1
        return random_scene(rng, unpack(stored[maze], level), scale)

    def __getitem__(self, index: int) -> dict[str, torch.Tensor | int]:
        scene = self.scene(index)
        encoding = self.encoder.encode(scene.occupancy_map(), scene.start, scene.goal)
        label = encoding.to_input(scene.enlarge(scene.label()), fill=OBSTACLE)
        ends = encoding.to_input(scene.enlarge(scene.ends), fill=0)
        return {
            "image": torch.from_numpy(np.array(encoding.image)),
            "label": torch.from_numpy(np.array(label)),
            "ends": torch.from_numpy(np.array(ends)),
            "level": len(scene.blocks),
        }


class ResumableSampler(Sampler[int]):
    """Consecutive sample numbers from ``first`` on; each process of a distributed run takes its share of every step."""

    def __init__(self, first: int, batches: int, batch_size: int, rank: int = 0, processes: int = 1) -> None:
        self.first, self.batches, self.batch_size = first, batches, batch_size
        self.rank, self.processes = rank, processes

    def __len__(self) -> int:
        return self.batches * self.batch_size

    def __iter__(self) -> Iterator[int]:
        for batch in range(self.batches):
            start = self.first + (batch * self.processes + self.rank) * self.batch_size
            yield from range(start, start + self.batch_size)


def class_frequencies(dataset: MazeDataset, samples: int = 200) -> list[float]:
    """Shares of the pixels of the three classes over the first samples."""
    counts = np.zeros(3)
    for i in range(min(samples, len(dataset))):
        counts += np.bincount(dataset[i]["label"].numpy().ravel(), minlength=3)
    return list(counts / counts.sum())
