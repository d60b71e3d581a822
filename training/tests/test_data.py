# SPDX-License-Identifier: BSD-3-Clause
"""Samples: repeatable, drawn by the library's encoder, labelled with the true path, in mixed batches."""

from __future__ import annotations

import numpy as np
import pytest
import torch
from helpers import path_of
from torch.utils.data import DataLoader

import lrrt
from lrrt_training.data import (
    LARGEST_SHRINK,
    MARKER_SIDE,
    MazeDataset,
    ResumableSampler,
    class_frequencies,
    possible_scales,
)

LEVELS = [7, 9, 11, 13]
WHITE, BLACK, RED, BLUE = (255, 255, 255), (0, 0, 0), (255, 0, 0), (0, 0, 255)


def dataset(store, size=64, **changes) -> MazeDataset:
    return MazeDataset(store, **{"split": "train", "levels": LEVELS, "size": size, "length": 1000, **changes})


def block_of(point: tuple[float, float], scale: int) -> tuple[int, int]:
    return int(point[1]) // scale, int(point[0]) // scale


def enlarged(blocks: np.ndarray, scale: int) -> np.ndarray:
    return blocks.repeat(scale, axis=0).repeat(scale, axis=1)


def colour_is(image: np.ndarray, colour: tuple[int, int, int]) -> np.ndarray:
    return (image == np.array(colour, dtype=np.uint8)[:, None, None]).all(axis=0)


def equal(one: dict, other: dict) -> bool:
    return one["level"] == other["level"] and all(torch.equal(one[k], other[k]) for k in ("image", "label", "ends"))


def test_item_depends_on_its_number_alone(store):
    forward = [dataset(store)[i] for i in range(12)]
    fresh = dataset(store)
    for i in reversed(range(12)):
        assert equal(fresh[i], forward[i])
    assert not any(equal(forward[i], forward[i + 1]) for i in range(11))
    assert not equal(dataset(store, seed=2)[0], forward[0])
    assert not equal(dataset(store, split="test")[0], forward[0])


def test_splits_draw_different_problems(store):
    drawn = [[len(dataset(store, split=split).scene(i).blocks) for i in range(20)] for split in ("train", "test")]
    assert drawn[0] != drawn[1]


def test_types_and_shapes(store):
    sample = dataset(store)[0]
    assert sample["image"].shape == (3, 64, 64)
    assert sample["label"].shape == sample["ends"].shape == (64, 64)
    assert {sample[k].dtype for k in ("image", "label", "ends")} == {torch.uint8}
    assert set(sample["label"].unique().tolist()) == {0, 1, 2}
    assert sample["level"] in LEVELS


@pytest.mark.parametrize("size", [64, 128])
def test_input_is_what_the_library_shows_the_network(store, size):
    samples, encoder = dataset(store, size), lrrt.Encoder(size=size, marker_side=MARKER_SIDE)
    scales = set()
    for i in range(30):
        scene = samples.scene(i)
        occupancy = lrrt.OccupancyMap.from_array(enlarged(scene.blocks, scene.scale))
        encoding = encoder.encode(occupancy, scene.start, scene.goal)
        assert samples[i]["image"].numpy().tobytes() == np.asarray(encoding.image).tobytes()
        scales.add(scene.scale)
    assert 1 in scales
    assert len(scales) > 3


def test_label_is_the_only_path_of_a_perfect_maze(perfect_store):
    samples = dataset(perfect_store)
    for i in range(60):
        scene = samples.scene(i)
        start, goal = block_of(scene.start, scene.scale), block_of(scene.goal, scene.scale)
        marked = {tuple(b) for b in np.argwhere(scene.label() == 2).tolist()}
        assert marked == path_of(scene.blocks, start, goal)
        assert np.array_equal(scene.label() == 1, scene.blocks)
        assert scene.ends[start] == 1
        assert scene.ends[goal] == 2
        assert (scene.ends > 0).sum() == 2


def test_label_of_a_maze_with_loops_is_a_shortest_path(store):
    samples = dataset(store, levels=[21], size=128)
    loops = 0
    for i in range(40):
        scene = samples.scene(i)
        start, goal = block_of(scene.start, scene.scale), block_of(scene.goal, scene.scale)
        assert (scene.label() == 2).sum() == len(path_of(scene.blocks, start, goal))
        assert scene.label()[start] == scene.label()[goal] == 2
        loops += (~scene.blocks).sum() > 2 * 100 - 1
    assert loops > 0


def test_label_lies_over_the_picture(store):
    """Free and path pixels are white, obstacles black, and nothing else is, except under the two markers."""
    samples, compared = dataset(store), 0
    for i in range(40):
        scene, sample = samples.scene(i), samples[i]
        if (len(scene.blocks) - 2) * scene.scale + 2 > samples.size:
            continue
        compared += 1
        image, label = sample["image"].numpy(), sample["label"].numpy()
        markers = colour_is(image, RED) | colour_is(image, BLUE)
        assert np.array_equal(colour_is(image, WHITE), (label != 1) & ~markers)
        assert np.array_equal(colour_is(image, BLACK), (label == 1) & ~markers)
        assert markers.sum() < 0.2 * markers.size
    assert compared > 20


def test_markers_lie_on_the_ends(store):
    """With one map pixel a block a marker is exactly the block."""
    samples = dataset(store, pixel_share=0.0)
    for i in range(20):
        image, ends = (samples[i][k].numpy() for k in ("image", "ends"))
        assert np.array_equal(colour_is(image, RED), ends == 1) or 64 // samples[i]["level"] < MARKER_SIDE
        assert (colour_is(image, RED) & (ends == 1)).any()
        assert (colour_is(image, BLUE) & (ends == 2)).any()


def test_every_batch_mixes_levels_and_scales(store):
    samples = dataset(store)
    for batch in DataLoader(samples, 16, sampler=ResumableSampler(0, 6, 16)):
        assert len(set(batch["level"].tolist())) >= 3
    assert 0.3 < np.mean([samples.scene(i).scale == 1 for i in range(100)]) < 0.7


def test_in_turn_takes_every_level_and_maze(store):
    samples = dataset(store, split="test", in_turn=True, length=24)
    scenes = [samples.scene(i) for i in range(24)]
    assert [len(s.blocks) for s in scenes] == LEVELS * 6
    for level in LEVELS:
        free = [(~s.blocks).sum() for s in scenes if len(s.blocks) == level]
        stored = [level * level - np.unpackbits(bits).sum() for bits in store.mazes("test", level)]
        assert sorted(free) == sorted(stored)


@pytest.mark.parametrize("size", [64, 128, 256])
@pytest.mark.parametrize("level", [7, 21, 49])
def test_possible_scales_keep_blocks_visible(level, size):
    for scale in possible_scales(level, size):
        crop = (level - 2) * scale + 2
        assert crop <= LARGEST_SHRINK * size
        zoom = size // crop if crop <= size else size / crop
        assert scale * zoom >= 3
    assert possible_scales(7, 64)
    assert not possible_scales(49, 128), "49 blocks would be too small"


def test_unknown_split_is_named(store):
    with pytest.raises(ValueError, match="'validation': expected one of train, evaluation, test"):
        dataset(store, split="validation")


def test_sampler_resumes_where_it_was():
    whole = list(ResumableSampler(0, 10, 4))
    assert whole == list(range(40))
    assert list(ResumableSampler(12, 7, 4)) == whole[12:]
    assert len(ResumableSampler(12, 7, 4)) == 28


def test_two_processes_share_every_step_without_overlap():
    """Also after a resume: whatever a step of both takes is the next eight numbers."""
    for first in (0, 24):
        ranks = [list(ResumableSampler(first, 5, 4, rank, 2)) for rank in (0, 1)]
        for step in range(5):
            taken = ranks[0][4 * step : 4 * step + 4] + ranks[1][4 * step : 4 * step + 4]
            assert taken == list(range(first + 8 * step, first + 8 * step + 8))


def test_class_frequencies_count_pixels(store):
    samples = dataset(store)
    labels = torch.stack([samples[i]["label"] for i in range(10)])
    expected = [float((labels == k).float().mean()) for k in range(3)]
    assert class_frequencies(samples, 10) == pytest.approx(expected, abs=1e-6)
