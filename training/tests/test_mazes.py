# SPDX-License-Identifier: BSD-3-Clause
"""Mazes: what makes a maze perfect, braided, repeatable."""

from __future__ import annotations

import numpy as np
import pytest
from helpers import free_edges, search

from lrrt_training import mazes

LEVELS = (5, 7, 13, 21, 35, 49)


def rng(*seed: int) -> np.random.Generator:
    return np.random.default_rng(list(seed))


def border(occupied: np.ndarray) -> np.ndarray:
    return np.concatenate((occupied[0], occupied[-1], occupied[:, 0], occupied[:, -1]))


def reached(occupied: np.ndarray) -> int:
    """Free blocks that the first free block reaches."""
    return len(search(occupied, tuple(np.argwhere(~occupied)[0])))


@pytest.mark.parametrize("algorithm", mazes.ALGORITHMS)
@pytest.mark.parametrize("level", LEVELS)
def test_perfect_maze_is_a_spanning_tree_of_its_cells(algorithm, level):
    for seed in range(4):
        occupied = mazes.perfect_maze(rng(seed), level, algorithm)
        assert occupied.shape == (level, level)
        assert occupied.dtype == bool
        cells = ((level - 1) // 2) ** 2
        assert not occupied[1::2, 1::2].any(), "every cell is free"
        assert occupied[::2, ::2].all(), "every corner between cells is wall"
        assert (~occupied).sum() == cells + (cells - 1), "a tree has one passage fewer than cells"
        assert reached(occupied) == (~occupied).sum(), "all is connected"
        assert border(occupied).all()


@pytest.mark.parametrize("seed", range(20))
def test_braided_maze_is_connected_and_has_loops(seed):
    perfect = mazes.perfect_maze(rng(seed), 21, mazes.ALGORITHMS[seed % 3])
    braided = mazes.braid(rng(seed, 1), perfect, 1.0)
    assert not (braided & ~perfect).any(), "walls are opened, none is added"
    assert border(braided).all()
    free = (~braided).sum()
    assert reached(braided) == free
    assert free_edges(braided) > free - 1, "a connected graph with more edges than a tree has loops"
    assert len(mazes.dead_ends(braided)) < len(mazes.dead_ends(perfect)) / 2


def test_braiding_no_dead_end_changes_nothing():
    perfect = mazes.perfect_maze(rng(1), 15, "prim")
    assert np.array_equal(mazes.braid(rng(2), perfect, 0.0), perfect)


def test_dead_ends_are_blocks_with_one_exit():
    occupied = np.ones((5, 5), dtype=bool)
    occupied[1, 1:4] = occupied[2, 3] = occupied[3, 3] = False
    assert mazes.dead_ends(occupied).tolist() == [[1, 1], [3, 3]]


@pytest.mark.parametrize("algorithm", mazes.ALGORITHMS)
def test_seed_decides_the_maze(algorithm):
    first = mazes.perfect_maze(rng(7), 21, algorithm)
    assert np.array_equal(first, mazes.perfect_maze(rng(7), 21, algorithm))
    assert not np.array_equal(first, mazes.perfect_maze(rng(8), 21, algorithm))


def test_algorithms_differ_in_character():
    """Depth-first corridors are long, so they have far fewer dead ends than Prim's."""
    dead = {
        a: np.mean([len(mazes.dead_ends(mazes.perfect_maze(rng(s), 31, a))) for s in range(8)])
        for a in mazes.ALGORITHMS
    }
    assert dead["dfs"] < 0.6 * dead["wilson"] < 0.6 * dead["prim"]


@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
def test_share_of_braided_mazes(share):
    level, number = 15, 60
    tree = 2 * ((level - 1) // 2) ** 2 - 1
    loops = sum((~mazes.random_maze(rng(s), level, share)).sum() > tree for s in range(number))
    assert abs(loops / number - share) < 0.2


def test_ends_are_free_different_and_often_far():
    occupied = mazes.perfect_maze(rng(3), 31, "wilson")
    source, distances = rng(4), []
    for _ in range(300):
        start, goal = mazes.random_ends(source, occupied)
        assert start != goal
        assert not occupied[start]
        assert not occupied[goal]
        distances.append(np.hypot(start[0] - goal[0], start[1] - goal[1]))
    assert min(distances) < 5, "near pairs occur, too"
    assert np.mean(distances) > 0.55 * 30, "random pairs are half a side apart on average"


@pytest.mark.parametrize("level", [4, 3, 20, 0, -7])
def test_bad_level_is_named(level):
    with pytest.raises(ValueError, match=rf"level {level}: expected an odd number"):
        mazes.perfect_maze(rng(0), level, "dfs")


def test_bad_algorithm_is_named():
    with pytest.raises(ValueError, match="'kruskal': expected one of dfs, prim, wilson"):
        mazes.perfect_maze(rng(0), 21, "kruskal")
