# SPDX-License-Identifier: BSD-3-Clause
"""Maze maps of m×m blocks with border walls, and start/goal pairs in them.

A maze of odd level m has ((m - 1) / 2)² cells at the odd rows and columns. A *perfect* maze is a spanning
tree of the cells; a *braided* one has some of its dead ends opened, so that it has loops.
"""

from __future__ import annotations

import random
from functools import lru_cache

import numpy as np

ALGORITHMS = ("dfs", "prim", "wilson")
_SHARE_OF_FAR_PAIRS = 0.7
_FAR_PAIR_CANDIDATES = 8

Edge = tuple[int, int]
Neighbours = tuple[tuple[int, ...], ...]


@lru_cache(maxsize=64)
def _neighbours(side: int) -> Neighbours:
    """Neighbouring cells of every cell of a side×side grid, cells numbered row by row."""
    steps = ((-1, 0), (1, 0), (0, -1), (0, 1))
    return tuple(
        tuple((row + dr) * side + col + dc for dr, dc in steps if 0 <= row + dr < side and 0 <= col + dc < side)
        for row in range(side)
        for col in range(side)
    )


def _pick(uniform, items):
    return items[int(uniform() * len(items))]


def _dfs(neighbours: Neighbours, uniform) -> list[Edge]:
    """Depth-first search with random turns (recursive backtracker): long winding corridors."""
    visited = bytearray(len(neighbours))
    stack = [int(uniform() * len(neighbours))]
    visited[stack[0]] = 1
    edges = []
    while stack:
        options = [n for n in neighbours[stack[-1]] if not visited[n]]
        if not options:
            stack.pop()
            continue
        cell = _pick(uniform, options)
        visited[cell] = 1
        edges.append((stack[-1], cell))
        stack.append(cell)
    return edges


def _prim(neighbours: Neighbours, uniform) -> list[Edge]:
    """Randomised Prim: a uniformly drawn edge of the frontier grows the tree; many short dead ends."""
    visited = bytearray(len(neighbours))
    first = int(uniform() * len(neighbours))
    visited[first] = 1
    frontier = [(first, n) for n in neighbours[first]]
    edges = []
    while frontier:
        i = int(uniform() * len(frontier))
        frontier[i], frontier[-1] = frontier[-1], frontier[i]
        edge = frontier.pop()
        cell = edge[1]
        if visited[cell]:
            continue
        visited[cell] = 1
        edges.append(edge)
        frontier.extend((cell, n) for n in neighbours[cell] if not visited[n])
    return edges


def _wilson(neighbours: Neighbours, uniform) -> list[Edge]:
    """Wilson's loop-erased random walks: every spanning tree is equally likely."""
    in_tree = bytearray(len(neighbours))
    in_tree[int(uniform() * len(neighbours))] = 1
    successor = [0] * len(neighbours)
    edges = []
    for first in range(len(neighbours)):
        cell = first
        while not in_tree[cell]:
            successor[cell] = _pick(uniform, neighbours[cell])
            cell = successor[cell]
        cell = first
        while not in_tree[cell]:
            in_tree[cell] = 1
            edges.append((cell, successor[cell]))
            cell = successor[cell]
    return edges


_GENERATORS = {"dfs": _dfs, "prim": _prim, "wilson": _wilson}


def _carve(side: int, edges: list[Edge]) -> np.ndarray:
    """Block map of a spanning tree of cells."""
    level = 2 * side + 1
    occupied = np.ones((level, level), dtype=bool)
    occupied[1::2, 1::2] = False
    rows, cols = np.divmod(np.asarray(edges, dtype=np.int64), side)
    occupied[rows.sum(axis=1) + 1, cols.sum(axis=1) + 1] = False
    return occupied


def check_level(level: int) -> None:
    """Raises ValueError unless the level is odd and at least 5."""
    if level < 5 or level % 2 == 0:
        raise ValueError(f"maze level {level}: expected an odd number of blocks, at least 5")


def perfect_maze(rng: np.random.Generator, level: int, algorithm: str) -> np.ndarray:
    """A perfect maze as a (level, level) bool array, True = occupied.

    Args:
        rng: source of all randomness.
        level: odd number of blocks a side, at least 5.
        algorithm: one of ``ALGORITHMS``.
    """
    check_level(level)
    if algorithm not in _GENERATORS:
        raise ValueError(f"maze algorithm {algorithm!r}: expected one of {', '.join(ALGORITHMS)}")
    side = (level - 1) // 2
    uniform = random.Random(int(rng.integers(2**63))).random
    return _carve(side, _GENERATORS[algorithm](_neighbours(side), uniform))


def dead_ends(occupied: np.ndarray) -> np.ndarray:
    """(N, 2) rows and columns of the free blocks that have one free neighbour only."""
    free = ~occupied
    count = np.zeros(free.shape, dtype=np.int8)
    count[1:] += free[:-1]
    count[:-1] += free[1:]
    count[:, 1:] += free[:, :-1]
    count[:, :-1] += free[:, 1:]
    return np.argwhere(free & (count == 1))


def braid(rng: np.random.Generator, occupied: np.ndarray, share: float) -> np.ndarray:
    """A copy in which about ``share`` of the dead ends got a second exit (through one inner wall)."""
    braided = occupied.copy()
    inner = range(1, len(occupied) - 1)
    ends = dead_ends(occupied)
    for row, col in ends[rng.random(len(ends)) < share]:
        around = ((row - 1, col), (row + 1, col), (row, col - 1), (row, col + 1))
        walls = [(r, c) for r, c in around if r in inner and c in inner and braided[r, c]]
        if walls and sum(not braided[r, c] for r, c in around) == 1:
            braided[walls[rng.integers(len(walls))]] = False
    return braided


def sometimes_braided(rng: np.random.Generator, occupied: np.ndarray, probability: float) -> np.ndarray:
    """The maze itself, or with a probability a copy in which a random part of its dead ends is opened."""
    return braid(rng, occupied, rng.uniform(0.1, 1.0)) if rng.random() < probability else occupied


def random_maze(rng: np.random.Generator, level: int, braided_share: float = 0.25) -> np.ndarray:
    """A maze of a random algorithm; with probability ``braided_share`` a random part of its dead ends is opened."""
    occupied = perfect_maze(rng, level, ALGORITHMS[rng.integers(len(ALGORITHMS))])
    return sometimes_braided(rng, occupied, braided_share)


def random_ends(rng: np.random.Generator, occupied: np.ndarray) -> tuple[tuple[int, int], tuple[int, int]]:
    """Start and goal as (row, column) of two different free blocks.

    Seven pairs in ten are the farthest (straight-line) of eight random pairs, the others are arbitrary.
    """
    free = np.argwhere(~occupied)
    candidates = _FAR_PAIR_CANDIDATES if rng.random() < _SHARE_OF_FAR_PAIRS else 1
    first = rng.integers(len(free), size=candidates)
    other = (first + rng.integers(1, len(free), size=candidates)) % len(free)
    best = np.argmax(((free[first] - free[other]) ** 2).sum(axis=1))
    start, goal = free[first[best]], free[other[best]]
    return (int(start[0]), int(start[1])), (int(goal[0]), int(goal[1]))
