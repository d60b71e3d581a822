# SPDX-License-Identifier: BSD-3-Clause
"""Maps of other projects: read as they were packed, split without overlap, absent without harm."""

from __future__ import annotations

import numpy as np
import pytest

from lrrt_training.families.external import (
    DUNGEON_FILE,
    MPD_ENVIRONMENTS,
    MPD_FILE,
    MPD_SPLITS,
    SPLITS,
    ExternalMaps,
)

COUNTS = {"train": 3, "validation": 2, "test": 1}
DUNGEONS = 43


def pictures(count: int, height: int, width: int, seed: int) -> np.ndarray:
    """Free pixels."""
    return np.random.default_rng(seed).random((count, height, width), dtype=np.float32) < 0.5


def write_mpd(folder) -> dict[str, np.ndarray]:
    free = {}
    for i, environment in enumerate(MPD_ENVIRONMENTS):
        for j, (split, count) in enumerate(COUNTS.items()):
            free[f"{environment}_{split}"] = pictures(count, 201, 201, 10 * i + j)
    np.savez(folder / MPD_FILE, **{key: np.packbits(f.reshape(len(f), -1), axis=1) for key, f in free.items()})
    return free


def write_dungeon(folder) -> np.ndarray:
    free = pictures(DUNGEONS, 480, 640, 99)
    boxes = np.zeros((DUNGEONS, 4), dtype=np.int16)
    names = np.array([f"img_{i}.png" for i in range(DUNGEONS)])
    np.savez(folder / DUNGEON_FILE, free_packbits=np.packbits(free, axis=2), start_box_xyxy=boxes, names=names)
    return free


def test_mpd_environments_take_turns(tmp_path):
    free = write_mpd(tmp_path)
    maps = ExternalMaps(tmp_path)
    assert maps.names() == ["mpd"]
    for split in SPLITS:
        name = MPD_SPLITS[split]
        assert maps.count("mpd", split) == len(MPD_ENVIRONMENTS) * COUNTS[name]
        for index in range(maps.count("mpd", split)):
            row, environment = divmod(index, len(MPD_ENVIRONMENTS))
            occupied = maps.map("mpd", split, index)
            assert occupied.dtype == bool
            assert np.array_equal(occupied, ~free[f"{MPD_ENVIRONMENTS[environment]}_{name}"][row])


def test_dungeon_splits_are_disjoint_and_complete(tmp_path):
    free = write_dungeon(tmp_path)
    maps = ExternalMaps(tmp_path)
    assert maps.names() == ["dungeon"]
    which = {picture.tobytes(): i for i, picture in enumerate(~free)}
    found = {
        split: [which[maps.map("dungeon", split, i).tobytes()] for i in range(maps.count("dungeon", split))]
        for split in SPLITS
    }
    assert found["test"] == [0, 20, 40]
    assert found["evaluation"] == [1, 21, 41]
    assert sorted(found["train"] + found["evaluation"] + found["test"]) == list(range(DUNGEONS))
    occupied = maps.map("dungeon", "test", 1)
    assert occupied.shape == (480, 640)
    assert occupied.dtype == bool


def test_both_files(tmp_path):
    write_mpd(tmp_path)
    write_dungeon(tmp_path)
    assert ExternalMaps(str(tmp_path)).names() == ["mpd", "dungeon"]


def test_missing_files_are_left_out(tmp_path):
    assert ExternalMaps(tmp_path).names() == []
    maps = ExternalMaps(tmp_path / "absent")
    assert maps.names() == []
    with pytest.raises(ValueError, match=r"'mpd'.*no file found"):
        maps.count("mpd", "train")


@pytest.mark.parametrize("file", [MPD_FILE, DUNGEON_FILE])
def test_broken_file_is_named_with_what_was_expected(tmp_path, file):
    expected = "forest_train" if file == MPD_FILE else "free_packbits"
    for content in (b"", b"not a zip file at all"):
        (tmp_path / file).write_bytes(content)
        with pytest.raises(ValueError, match=rf"{file}: expected .*{expected}"):
            ExternalMaps(tmp_path)
    np.savez(tmp_path / file, other=np.zeros(3))
    with pytest.raises(ValueError, match=rf"{file}: expected .*{expected}"):
        ExternalMaps(tmp_path)


def test_cut_off_file_is_an_error(tmp_path):
    write_mpd(tmp_path)
    whole = (tmp_path / MPD_FILE).read_bytes()
    (tmp_path / MPD_FILE).write_bytes(whole[: len(whole) // 2])
    with pytest.raises(ValueError, match=MPD_FILE):
        ExternalMaps(tmp_path)


def test_wrong_shape_is_an_error(tmp_path):
    np.savez(tmp_path / DUNGEON_FILE, free_packbits=np.zeros((2, 480, 79), dtype=np.uint8))
    with pytest.raises(ValueError, match=r"expected .*480, 80.*\(2, 480, 79\)"):
        ExternalMaps(tmp_path)


def test_wrong_name_split_or_index(tmp_path):
    write_mpd(tmp_path)
    maps = ExternalMaps(tmp_path)
    with pytest.raises(ValueError, match=r"'dungeon'.*mpd"):
        maps.map("dungeon", "train", 0)
    with pytest.raises(ValueError, match=r"'validation'.*evaluation"):
        maps.count("mpd", "validation")
    for index in (-1, 12):
        with pytest.raises(IndexError, match="of 12 maps"):
            maps.map("mpd", "train", index)
