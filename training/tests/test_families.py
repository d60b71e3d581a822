# SPDX-License-Identifier: BSD-3-Clause
"""Random maps: repeatable, of the promised shape, with room to plan in."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import ndimage

from lrrt_training.families import FAMILIES, LEAST_CONNECTED, LEAST_FREE, corridors, draw, random_map
from lrrt_training.families.distort import PROBABILITIES, _enclose, _outline, _ragged, _rotate, distort

SIDE, SEEDS = 96, 20
ASPECT = 3.0


def rng(*seed: int) -> np.random.Generator:
    return np.random.default_rng(list(seed))


def sizes(occupied: np.ndarray) -> np.ndarray:
    """Pixels of every 4-connected free part."""
    return np.bincount(ndimage.label(~occupied)[0].ravel())[1:]


@pytest.fixture(params=list(FAMILIES))
def family(request) -> str:
    return request.param


def test_same_seed_same_map(family):
    for seed in range(5):
        assert np.array_equal(FAMILIES[family](rng(seed), SIDE), FAMILIES[family](rng(seed), SIDE))
        assert np.array_equal(random_map(rng(seed), family, SIDE), random_map(rng(seed), family, SIDE))


def test_different_seeds_differ(family):
    maps = {random_map(rng(seed), family, SIDE).tobytes() for seed in range(SEEDS)}
    assert len(maps) == SEEDS


@pytest.mark.parametrize("side", [64, 65, SIDE, 512])
def test_drawing_is_a_bool_array_of_the_longer_side(family, side):
    for seed in range(SEEDS if side < 512 else 3):
        occupied = FAMILIES[family](rng(seed, side), side)
        assert occupied.dtype == bool
        assert occupied.ndim == 2
        assert max(occupied.shape) == side
        assert max(occupied.shape) <= ASPECT * min(occupied.shape)
        assert occupied.any()


def test_random_map_has_room(family):
    for seed in range(SEEDS):
        occupied = random_map(rng(seed), family, SIDE)
        assert occupied.dtype == bool
        assert max(occupied.shape) == SIDE
        assert max(occupied.shape) <= ASPECT * min(occupied.shape)
        assert (~occupied).mean() >= LEAST_FREE
        assert sizes(occupied).max() >= LEAST_CONNECTED * occupied.size
        assert occupied.any()


def test_unknown_family_is_named():
    with pytest.raises(ValueError, match=r"'lawn'.*rooms"):
        random_map(rng(0), "lawn", SIDE)


def test_unusable_maps_are_drawn_again(monkeypatch):
    made = []

    def mostly_full(generator, side):
        made.append(side)
        occupied = np.ones((side, side), dtype=bool)
        if len(made) > 3:
            occupied[: side // 2] = False
        return occupied

    monkeypatch.setitem(FAMILIES, "mostly_full", mostly_full)
    for name in PROBABILITIES:
        monkeypatch.setitem(PROBABILITIES, name, 0.0)
    assert (~random_map(rng(0), "mostly_full", 64)).mean() == pytest.approx(0.5)
    assert made == [64] * 4


@pytest.mark.parametrize("rows, cols", [(2, 2), (2, 9), (7, 3), (12, 12)])
def test_rectangular_maze_is_connected_and_walled(rows, cols):
    for seed in range(10):
        blocks = corridors.rectangular_maze(rng(seed), rows, cols, 0.0)
        assert blocks.shape == (2 * rows + 1, 2 * cols + 1)
        assert not blocks[1::2, 1::2].any()
        assert len(sizes(blocks)) == 1
        assert blocks[0].all() and blocks[-1].all() and blocks[:, 0].all() and blocks[:, -1].all()
        assert (~blocks).sum() == 2 * rows * cols - 1, "a tree has one passage fewer than cells"


def test_mazes_stay_connected_in_pixels():
    for seed in range(SEEDS):
        occupied = FAMILIES["corridor_maze"](rng(seed), SIDE)
        assert len(sizes(occupied)) == 1
        assert occupied[0].all() and occupied[:, -1].all()


def test_widths_sum_up():
    for seed in range(50):
        generator = rng(seed)
        count, low = int(generator.integers(1, 12)), int(generator.integers(1, 9))
        made = draw.widths(generator, 97, count, low, 0.6)
        assert made.sum() == 97
        assert made.min() >= min(low, 97 // count)


@pytest.mark.parametrize("thickness", [2, 3, 4, 7])
def test_strokes_do_not_leak(thickness):
    for seed in range(20):
        angle = rng(seed).uniform(0, np.pi)
        reach = 100 * np.array([np.sin(angle), np.cos(angle)])
        occupied = np.zeros((64, 64), dtype=bool)
        draw.stroke(occupied, np.stack((31.5 - reach, 31.5 + reach)), thickness)
        eight = np.ones((3, 3))
        assert ndimage.label(~occupied, eight)[1] == 2


def test_distort_keeps_type_and_shape(family):
    for seed in range(10):
        drawn = FAMILIES[family](rng(seed), SIDE)
        before = drawn.copy()
        occupied = distort(rng(seed, 1), drawn)
        assert occupied.dtype == bool
        assert occupied.shape == drawn.shape
        assert occupied.any() and not occupied.all()
        assert np.array_equal(drawn, before), "the drawing itself stays as it was"
        assert np.array_equal(occupied, distort(rng(seed, 1), drawn))


@pytest.mark.parametrize("value", [True, False])
def test_distort_never_returns_an_empty_or_full_map(value):
    for seed in range(SEEDS):
        occupied = distort(rng(seed), np.full((64, 80), value))
        assert occupied.any() and not occupied.all()


@pytest.mark.parametrize("change", [_ragged, _rotate, _outline])
def test_walls_do_not_leak(change):
    """A closed thin box keeps inside and outside apart, diagonally too where walls are turned."""
    for seed in range(SEEDS):
        occupied = np.zeros((SIDE, SIDE), dtype=bool)
        occupied[30:70, 30:70] = True
        thickness = seed % 4 + 1
        occupied[30 + thickness : 70 - thickness, 30 + thickness : 70 - thickness] = False
        changed = change(rng(seed), occupied)
        labels, _ = ndimage.label(~changed, np.ones((3, 3)) if change is _rotate else None)
        assert labels[50, 50] not in (0, labels[48, 5], labels[5, 48])


def test_ragged_boundaries_change_no_connection(family):
    """As many free parts (4-connected) and obstacles (8-connected, the outside is one) as before."""
    for seed in range(10):
        occupied = FAMILIES[family](rng(seed), SIDE)
        ragged = _ragged(rng(seed), occupied)
        assert not np.array_equal(ragged, occupied)
        assert len(sizes(ragged)) == len(sizes(occupied))
        parts = [ndimage.label(np.pad(o, 1, constant_values=True), np.ones((3, 3)))[1] for o in (occupied, ragged)]
        assert parts[0] == parts[1]


def test_unreachable_parts_are_enclosed():
    occupied = np.zeros((64, 64), dtype=bool)
    occupied[20] = True
    enclosed = _enclose(occupied)
    assert enclosed[:21].all()
    assert not enclosed[21:].any()
