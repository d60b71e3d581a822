# SPDX-License-Identifier: BSD-3-Clause
"""Samples: repeatable, drawn by the library's encoder, labelled with the true path; and the order they come in."""

from __future__ import annotations

from itertools import chain
from types import SimpleNamespace

import numpy as np
import pytest
import torch
from helpers import free_edges, path_of
from scipy import ndimage

import lrrt
from lrrt_training import families
from lrrt_training.data import MARKER_SIDE, Curriculum, CurriculumBatches, RegionData, SceneDataset, Stage
from lrrt_training.families.external import ExternalMaps
from lrrt_training.scenes import (
    LARGEST_SHRINK,
    RADIUS,
    MapScene,
    MazeScene,
    SceneSource,
    possible_scales,
    random_ends,
    random_map_scene,
)

LEVELS = [7, 9, 11, 13]
WHITE, BLACK, RED, BLUE = (255, 255, 255), (0, 0, 0), (255, 0, 0), (0, 0, 255)
EIGHT = np.ones((3, 3))


class Outside:
    """Maps of other sources: three rooms, told apart by a pixel."""

    def names(self) -> list[str]:
        return ["rooms outside"]

    def count(self, name: str, split: str) -> int:
        return 3

    def map(self, name: str, split: str, index: int) -> np.ndarray:
        occupied = np.zeros((40, 60), dtype=bool)
        occupied[:, 30] = True
        occupied[18:22, 30] = False
        occupied[1, index] = True
        return occupied


def dataset(store, split="train", external=None, seed=1, **stage) -> SceneDataset:
    first = Stage(**{"size": 64, "samples": 1000, "batch_size": 16, "levels": LEVELS, **stage})
    source = SceneSource(store, external or ExternalMaps("absent"), split)
    return SceneDataset(Curriculum([first]), source, seed)


def block_of(point: tuple[float, float], scale: int) -> tuple[int, int]:
    return int(point[1]) // scale, int(point[0]) // scale


def pixel_of(point: tuple[float, float]) -> tuple[int, int]:
    return block_of(point, 1)


def enlarged(blocks: np.ndarray, scale: int) -> np.ndarray:
    return blocks.repeat(scale, axis=0).repeat(scale, axis=1)


def colour_is(image: np.ndarray, colour: tuple[int, int, int]) -> np.ndarray:
    return (image == np.array(colour, dtype=np.uint8)[:, None, None]).all(axis=0)


def equal(one: dict, other: dict) -> bool:
    return one["index"] == other["index"] and all(torch.equal(one[k], other[k]) for k in ("image", "label"))


def test_sample_depends_on_seed_split_and_number_alone(store):
    shares = {"family_share": 0.3, "external_share": 0.3, "external": Outside()}
    forward = [dataset(store, **shares)[i] for i in range(12)]
    fresh = dataset(store, **shares)
    for i in reversed(range(12)):
        assert equal(fresh[i], forward[i])
    pictures = {sample["image"].numpy().tobytes() for sample in forward}
    assert len(pictures) == 12
    for other in (dataset(store, seed=2, **shares), dataset(store, split="test", **shares)):
        assert not any(other[i]["image"].numpy().tobytes() in pictures for i in range(6))


def test_types_and_shapes(store):
    sample = dataset(store)[3]
    assert set(sample) == {"image", "label", "index"}
    assert sample["image"].shape == (3, 64, 64)
    assert sample["label"].shape == (64, 64)
    assert {sample[k].dtype for k in ("image", "label")} == {torch.uint8}
    assert set(sample["label"].unique().tolist()) == {0, 1, 2}
    assert sample["index"] == 3


def test_batches_of_a_stage_take_several_sides_in_turn(store):
    stage = {"size": 128, "other_sizes": [64, 128, 96], "batch_size": 2, "least_block": 9}
    samples = dataset(store, levels=[5, 9, 11], **stage)
    for i in range(24):
        side = [128, 64, 128, 96][i // 2 % 4]
        assert samples[i]["image"].shape == (3, side, side) and samples[i]["label"].shape == (side, side)
        assert 9 * len(samples.scene(i).blocks) <= side, "a level too fine for this side"
    batches = list(CurriculumBatches(samples.curriculum, rank=1, processes=2))
    assert all(len({samples.curriculum.size_at(i) for i in batch}) == 1 for batch in batches)


@pytest.mark.parametrize("wrong", [{"least_block": 5.0}, {"other_sizes": [32], "least_block": 0.5}])
def test_sides_that_no_maze_fits_are_refused(wrong):
    with pytest.raises(ValueError, match="least_block"):
        Stage(16, 8, 4, [5, 7], **wrong)


@pytest.mark.parametrize("size", [64, 128])
def test_input_is_what_the_library_shows_the_network(store, size):
    """Byte for byte, for mazes, families and maps of other sources."""
    samples = dataset(store, external=Outside(), size=size, family_share=0.2, external_share=0.1)
    encoder = lrrt.Encoder(size=size, marker_side=MARKER_SIDE)
    kinds, scales = set(), set()
    for i in range(40):
        scene = samples.scene(i)
        if isinstance(scene, MazeScene):
            occupied = enlarged(scene.blocks, scene.scale)
            scales.add(scene.scale)
        else:
            occupied = scene.occupied
        kinds.add(type(scene))
        encoding = encoder.encode(lrrt.OccupancyMap.from_array(occupied), scene.start, scene.goal)
        assert samples[i]["image"].numpy().tobytes() == np.asarray(encoding.image).tobytes()
        label = encoding.to_input(scene.label(encoding.scale), fill=1)
        assert np.array_equal(samples[i]["label"].numpy(), label)
    assert kinds == {MazeScene, MapScene}
    assert 1 in scales and len(scales) > 3


def test_a_marker_stands_on_either_end(store):
    samples = dataset(store, external=Outside(), family_share=0.2, external_share=0.2)
    for i in range(30):
        start, goal = (colour_is(samples[i]["image"].numpy(), colour).sum() for colour in (RED, BLUE))
        assert goal > 0
        assert start > 0 or goal < 2 * MARKER_SIDE**2, "only a near goal covers the start"


def test_label_lies_over_the_picture(store):
    """Free and path pixels are white, obstacles black, and nothing else is, except under the two markers."""
    samples, compared = dataset(store), 0
    for i in range(40):
        scene, sample = samples.scene(i), samples[i]
        if (len(scene.blocks) - 2) * scene.scale + 2 > 64:
            continue
        compared += 1
        image, label = sample["image"].numpy(), sample["label"].numpy()
        markers = colour_is(image, RED) | colour_is(image, BLUE)
        assert np.array_equal(colour_is(image, WHITE), (label != 1) & ~markers)
        assert np.array_equal(colour_is(image, BLACK), (label == 1) & ~markers)
        assert markers.sum() < 0.2 * markers.size
    assert compared > 20


def test_label_is_the_only_path_of_a_perfect_maze(perfect_store):
    samples = dataset(perfect_store)
    for i in range(60):
        scene = samples.scene(i)
        start, goal = block_of(scene.start, scene.scale), block_of(scene.goal, scene.scale)
        wanted = scene.blocks.astype(int)
        for block in path_of(scene.blocks, start, goal):
            wanted[block] = 2
        assert np.array_equal(scene.label(1.0), enlarged(wanted, scene.scale))


def test_label_of_a_maze_with_loops_is_a_shortest_path(store):
    samples = dataset(store, levels=[21], size=128)
    loops = 0
    for i in range(40):
        scene = samples.scene(i)
        start, goal = block_of(scene.start, scene.scale), block_of(scene.goal, scene.scale)
        label = scene.label(1.0)[:: scene.scale, :: scene.scale]
        assert (label == 2).sum() == len(path_of(scene.blocks, start, goal))
        assert label[start] == label[goal] == 2
        assert ndimage.label(label == 2)[1] == 1
        loops += (~scene.blocks).sum() > 2 * 100 - 1
    assert loops > 0


@pytest.mark.parametrize("family", list(families.FAMILIES))
def test_label_of_a_map_joins_the_ends_in_free_space(store, family):
    source = SceneSource(store, ExternalMaps("absent"), "train")
    for seed in range(3):
        scene = source.family(np.random.default_rng(seed), family, 64)
        assert scene.group == family
        for scale in (0.5, 2.0):
            label = scene.label(scale)
            path = label == 2
            assert label.dtype == np.uint8
            assert not (path & scene.occupied).any()
            assert np.array_equal(label == 1, scene.occupied)
            assert path[pixel_of(scene.start)] and path[pixel_of(scene.goal)]
            assert ndimage.label(path, EIGHT)[1] == 1


def walled(diagonal: bool) -> np.ndarray:
    """60×60 free pixels in two halves; a wall of one pixel between them is open at one end."""
    occupied = np.zeros((60, 60), dtype=bool)
    if diagonal:
        np.fill_diagonal(occupied, True)
        occupied[50:, 50:] = False
    else:
        occupied[30, :50] = True
    return occupied


@pytest.mark.parametrize("diagonal", [False, True])
@pytest.mark.parametrize("scale", [0.2, 0.5, 1.0])
def test_label_never_leaks_through_a_wall(diagonal, scale):
    """A path along one side of the wall; its region, up to 25 pixels wide, is a walk around the wall's end away."""
    occupied = walled(diagonal)
    ends = ((5.5, 9.5), (8.5, 14.5)) if diagonal else ((5.5, 32.5), (15.5, 32.5))
    path = MapScene(occupied, *ends, "wall").label(scale) == 2
    rows, columns = np.indices(occupied.shape)
    beyond = columns > rows if diagonal else rows < 30
    assert path.sum() > 30
    assert not (path & beyond).any()


def test_label_is_as_wide_as_promised():
    """In the open: RADIUS pixels of the input to both sides."""
    for scale in (0.5, 1.0, 2.0):
        scene = MapScene(np.zeros((80, 80), dtype=bool), (10.5, 40.5), (69.5, 40.5), "open")
        column = (scene.label(scale) == 2)[:, 40]
        assert column[40]
        assert abs(column.sum() - (2 * RADIUS / scale + 1)) <= 2


def test_path_keeps_away_from_walls_where_it_can():
    """Between a wall on one side and open space on the other the middle of the region is off the wall."""
    occupied = np.zeros((64, 64), dtype=bool)
    occupied[30:34, 4:60] = True
    scene = MapScene(occupied, (2.5, 28.5), (61.5, 28.5), "wall")
    rows = np.flatnonzero(scene.label(1.0)[:, 32] == 2)
    assert rows.mean() < 28


def test_every_symmetry_of_a_map_occurs():
    occupied = np.zeros((4, 6), dtype=bool)
    occupied[0, 1] = True
    rng = np.random.default_rng(0)
    seen = {
        scene.occupied.tobytes() + bytes(scene.occupied.shape)
        for scene in (random_map_scene(rng, occupied, "x") for _ in range(100))
    }
    assert len(seen) == 8


def test_ends_lie_in_the_largest_part():
    occupied = np.ones((30, 30), dtype=bool)
    occupied[2:5, 2:5] = occupied[10:28, 10:28] = occupied[9, 9] = False
    rng = np.random.default_rng(0)
    apart = []
    for _ in range(200):
        start, goal = random_ends(rng, occupied)
        for x, y in (start, goal):
            assert 10 < x < 28 and 10 < y < 28
            assert x % 1 == y % 1 == 0.5
        assert start != goal
        apart.append(np.hypot(start[0] - goal[0], start[1] - goal[1]))
    assert np.mean(apart) > 0.6 * 18, "often far, as random pairs are half a side apart"


@pytest.mark.parametrize(("free", "message"), [([], "no free pixel"), ([(1, 1), (2, 2)], "no two free pixels")])
def test_maps_without_room_are_errors(free, message):
    occupied = np.ones((4, 4), dtype=bool)
    for pixel in free:
        occupied[pixel] = False
    with pytest.raises(ValueError, match=message):
        random_ends(np.random.default_rng(0), occupied)


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


def test_shares_of_mazes_families_and_other_maps(store):
    """Within four standard deviations of a binomial count; the families are drawn evenly."""
    number = 500
    samples = dataset(store, external=Outside(), family_share=0.3, external_share=0.2)
    drawn: list[str] = []
    samples.source = SimpleNamespace(
        split="train",
        external=samples.source.external,
        family=lambda rng, family, size: drawn.append(family),
        outside=lambda rng, name: drawn.append(name),
        maze=lambda rng, level, size, share, braided_share: drawn.append(str(level)),
    )
    for i in range(number):
        samples.scene(i)
    counts = {
        0.3: sum(name in families.FAMILIES for name in drawn),
        0.2: drawn.count("rooms outside"),
        0.5: sum(name.isdecimal() for name in drawn),
    }
    for share, count in counts.items():
        assert abs(count - share * number) < 4 * np.sqrt(number * share * (1 - share))
    assert set(drawn) == {*families.FAMILIES, "rooms outside", *map(str, LEVELS)}


def test_share_of_mazes_with_several_pixels_a_block(store):
    scales = [dataset(store, pixel_share=share).scene(i).scale for share in (0.0, 1.0, 0.5) for i in range(80)]
    assert set(scales[:80]) == {1}
    assert 1 not in scales[80:160]
    assert abs(np.mean([s == 1 for s in scales[160:]]) - 0.5) < 4 * np.sqrt(0.25 / 80)


def test_families_are_drawn_as_often_as_they_are_named(store):
    samples = dataset(store, family_share=1.0, families=["city", "city", "city", "forest"])
    drawn: list[str] = []
    samples.source = SimpleNamespace(
        split="train",
        external=samples.source.external,
        family=lambda rng, family, size: drawn.append(family),
    )
    for i in range(400):
        samples.scene(i)
    assert set(drawn) == {"city", "forest"}
    assert abs(drawn.count("city") - 300) < 4 * np.sqrt(400 * 0.75 * 0.25)


@pytest.mark.parametrize("wrong", [["castle"], []])
def test_unknown_families_are_named(wrong):
    with pytest.raises(ValueError, match="expected at least one of corridor_maze"):
        Stage(64, 10, 5, [7], families=wrong)


def test_share_of_mazes_that_get_loops(perfect_store):
    def looped(share: float) -> list[bool]:
        samples = dataset(perfect_store, levels=[13], pixel_share=0.0, braided_share=share)
        blocks = [samples.scene(i).blocks for i in range(80)]
        return [free_edges(b) >= (~b).sum() for b in blocks]

    assert not any(looped(0.0))
    assert abs(np.mean(looped(0.5)) - 0.5) < 4 * np.sqrt(0.25 / 80) + 0.05, "a braiding may open nothing"


def test_without_other_maps_their_share_goes_to_mazes(store):
    samples = dataset(store, external_share=1.0)
    assert all(isinstance(samples.scene(i), MazeScene) for i in range(5))


def test_groups_take_the_mazes_in_turn(store):
    groups = SceneSource(store, Outside(), "test").groups([7, 9], 64)
    assert list(groups) == ["7", "9", *families.FAMILIES, "rooms outside"]
    for level in (7, 9):
        scenes = [groups[str(level)](np.random.default_rng(i), i) for i in range(12)]
        assert {s.group for s in scenes} == {str(level)}
        stored = sorted(level * level - np.unpackbits(bits).sum() for bits in store.mazes("test", level))
        for half in (scenes[:6], scenes[6:]):
            assert sorted((~s.blocks).sum() for s in half) == stored
    scene = groups["city"](np.random.default_rng(0), 0)
    assert scene.group == "city" and max(scene.occupied.shape) <= 1.6 * 64
    marks = {groups["rooms outside"](np.random.default_rng(0), n).occupied.tobytes() for n in range(6)}
    assert len(marks) == 3


def curriculum(*samples: int, batch_size: int = 4) -> Curriculum:
    return Curriculum([Stage(32, n, batch_size, [5, 7, 9, 11]) for n in samples])


def test_samples_of_stages_are_numbered_through():
    plan = curriculum(24, 18, 7)
    assert (plan.samples, [plan.begin(i) for i in range(3)]) == (49, [0, 24, 42])
    assert [plan.stage_at(i) for i in (0, 23, 24, 41, 42, 48)] == [0, 0, 1, 1, 2, 2]
    with pytest.raises(IndexError, match="sample 49: the curriculum has 49"):
        plan.stage_at(49)


def test_batches_take_every_sample_once_and_never_mix_stages():
    batches = list(CurriculumBatches(curriculum(24, 18, 8)))
    assert list(chain(*batches)) == [*range(40), *range(42, 50)], "18 samples are four batches and a rest of two"
    assert {len(batch) for batch in batches} == {4}
    plan = curriculum(24, 18, 8)
    assert all(len({plan.stage_at(i) for i in batch}) == 1 for batch in batches)


def test_every_batch_mixes_levels(store):
    samples = dataset(store, levels=LEVELS, family_share=0.2)
    for batch in list(CurriculumBatches(samples.curriculum))[:6]:
        assert len({samples.scene(i).group for i in batch} & set(map(str, LEVELS))) >= 3


@pytest.mark.parametrize("processes", [1, 2])
def test_batches_go_on_where_they_were(processes):
    """From every step on, also between two stages; the length is that of the whole."""
    plan = curriculum(24, 18, 8)
    for rank in range(processes):
        whole = list(CurriculumBatches(plan, 0, rank, processes))
        for step in range(len(whole) + 1):
            # what RegionModule notes after a step: the first number after it
            first = 0 if step == 0 else whole[step - 1][0] - 4 * rank + 4 * processes
            rest = CurriculumBatches(plan, first, rank, processes)
            assert list(rest) == whole[step:]
            assert len(rest) == len(whole) == (12 if processes == 1 else 6)
        begins = CurriculumBatches(plan, 24, rank, processes)
        assert list(begins) == whole[24 // (4 * processes) :]


def test_a_number_within_a_step_begins_with_the_next_one():
    assert next(iter(CurriculumBatches(curriculum(24), 5)))[0] == 8


def test_two_processes_share_every_step_without_overlap():
    plan = curriculum(24, 18, 8)
    steps = list(zip(*(CurriculumBatches(plan, rank=rank, processes=2) for rank in (0, 1))))
    assert [a + b for a, b in steps] == [list(range(at, at + 8)) for at in (0, 8, 16, 24, 32, 42)]


def test_learning_rate_rises_shortly_then_falls_to_zero():
    stage = Stage(32, 1000, 4, [5], learning_rate=0.5)
    progress = np.linspace(0, 1, 1001)
    rate = np.array([stage.learning_rate_at(p) for p in progress])
    top = int(rate.argmax())
    assert 0 < rate[0] < 0.05 * 0.5
    assert progress[top] == pytest.approx(0.03, abs=0.005)
    assert rate[top] == pytest.approx(0.5, abs=0.005)
    assert (np.diff(rate[: top + 1]) > 0).all()
    assert (np.diff(rate[top:]) < 0).all()
    assert rate[500] == pytest.approx(0.25, abs=0.005)
    assert rate[-1] == pytest.approx(0.0, abs=1e-12)
    assert stage.learning_rate_at(1.2) == pytest.approx(0.0, abs=1e-12), "past the end it stays there"


def test_every_stage_has_a_learning_rate_of_its_own():
    plan = Curriculum([Stage(32, 100, 4, [5], learning_rate=1.0), Stage(64, 50, 4, [5], learning_rate=0.2)])
    assert plan.learning_rate_at(50) == plan.stages[0].learning_rate_at(0.5)
    assert plan.learning_rate_at(100) == plan.stages[1].learning_rate_at(0.0)
    assert plan.learning_rate_at(125) == plan.stages[1].learning_rate_at(0.5)


@pytest.fixture
def data(store) -> RegionData:
    stages = [Stage(32, 8, 4, [5]), Stage(64, 12, 4, [7, 9])]
    return RegionData(stages, store.folder, store.folder / "absent", workers=0)


def test_class_frequencies_count_pixels_of_the_last_stage(data):
    labels = torch.stack([data.dataset()[i]["label"] for i in range(8, 20)])
    expected = [float((labels == k).float().mean()) for k in range(3)]
    assert data.class_frequencies() == pytest.approx(expected, abs=1e-6)
    first = data.dataset()[8]["label"]
    assert data.class_frequencies(1) == pytest.approx([float((first == k).float().mean()) for k in range(3)])


def test_pictures_are_inputs_of_the_last_stage(data):
    pictures, samples = data.pictures(3), data.dataset()
    assert torch.equal(pictures, torch.stack([samples[i]["image"] for i in (8, 12, 16)]))
    assert data.pictures(2, 96).shape == (2, 3, 96, 96)


def test_loader_goes_on_where_the_state_says(data):
    data.trainer = SimpleNamespace(global_rank=0, world_size=1)
    data.load_state_dict({"first": 8})
    assert data.state_dict() == {"first": 8}
    loader = data.train_dataloader()
    batches = list(loader)
    assert [batch["index"].tolist() for batch in batches] == [[8, 9, 10, 11], [12, 13, 14, 15], [16, 17, 18, 19]]
    assert {tuple(batch["image"].shape) for batch in batches} == {(4, 3, 64, 64)}
    assert len(loader) == 5, "steps of the whole run"


def test_missing_mazes_are_made(tmp_path):
    data = RegionData([Stage(32, 8, 4, [5]), Stage(32, 8, 4, [5, 7])], tmp_path, tmp_path / "absent")
    data.prepare_data()
    assert {str(p.relative_to(tmp_path)) for p in tmp_path.rglob("*.npz")} == {"train/5.npz", "train/7.npz"}
    assert data.dataset()[0]["image"].shape == (3, 32, 32)
