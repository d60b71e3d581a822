# SPDX-License-Identifier: BSD-3-Clause
"""Mazes on disk: made once, whole or absent, never shared between splits."""

from __future__ import annotations

import hashlib
import json

import numpy as np
import pytest

from lrrt_training.store import SPLITS, MazeStore, pack, unpack

FEW = {"train": 5, "evaluation": 3, "test": 3}


@pytest.fixture
def folder(tmp_path):
    return tmp_path / "mazes"


def small(folder, **changes) -> MazeStore:
    return MazeStore(folder, **{"counts": FEW, **changes})


def stamps(folder) -> dict[str, int]:
    return {str(p.relative_to(folder)): p.stat().st_mtime_ns for p in folder.rglob("*.npz")}


def test_packing_is_reversible():
    pictures = np.random.default_rng(0).random((4, 7, 7)) < 0.5
    packed = pack(pictures)
    assert packed.shape == (4, 7)
    for picture, bits in zip(pictures, packed):
        assert np.array_equal(unpack(bits, 7), picture)


def test_generate_makes_what_is_missing_and_nothing_else(folder):
    store = small(folder)
    assert store.generate([7, 9], workers=1) == 6
    before = stamps(folder)
    assert set(before) == {f"{split}/{level}.npz" for split in SPLITS for level in (7, 9)}
    assert small(folder).generate([7, 9]) == 0
    store.path("test", 9).unlink()
    assert small(folder).generate([7, 9], workers=1) == 1
    after = stamps(folder)
    assert [name for name in after if after[name] != before[name]] == ["test/9.npz"]
    others = [p.name for p in folder.rglob("*") if p.is_file() and p.suffix != ".npz"]
    assert others == ["manifest.json"], "no temporary file stays"


@pytest.mark.parametrize("changes", [{"seed": 5}, {"braided_share": 1.0}, {"counts": {**FEW, "test": 4}}])
def test_other_settings_make_the_file_anew(folder, changes):
    small(folder).generate([11], ("test",), workers=1)
    first = small(folder).mazes("test", 11)
    other = small(folder, **changes)
    with pytest.raises(FileNotFoundError):
        other.mazes("test", 11)
    assert other.generate([11], ("test",), workers=1) == 1
    assert not np.array_equal(first, other.mazes("test", 11))


@pytest.mark.parametrize("length", [0, 1, 30, 0.5, -1])
def test_truncated_file_is_made_anew(folder, length):
    store = small(folder)
    store.generate([9], ("train",), workers=1)
    path = store.path("train", 9)
    whole = path.read_bytes()
    path.write_bytes(whole[: int(length * len(whole)) if isinstance(length, float) else length])
    again = small(folder)
    assert again.generate([9], ("train",), workers=1) == 1
    assert np.array_equal(again.mazes("train", 9), store.mazes("train", 9))


def test_mazes_do_not_depend_on_count_or_order(folder, tmp_path):
    one, two = small(folder), MazeStore(tmp_path / "other", counts={"train": 9})
    one.generate([7, 9], ("train",), workers=1)
    two.generate([9, 7], ("train",), workers=1)
    assert np.array_equal(one.mazes("train", 9), two.mazes("train", 9)[:5])


def test_splits_share_no_maze(folder):
    store = MazeStore(folder, counts=dict.fromkeys(SPLITS, 30))
    store.generate([21], workers=1)
    rows = [row.tobytes() for split in SPLITS for row in store.mazes(split, 21)]
    assert len(set(rows)) == len(rows) == 90


def test_missing_file_says_what_to_do(folder):
    with pytest.raises(FileNotFoundError, match=r"21\.npz: no mazes of level 21 .*generate"):
        small(folder).mazes("test", 21)


def test_bad_level_and_split_are_named(folder):
    with pytest.raises(ValueError, match="level 22"):
        small(folder).generate([22])
    with pytest.raises(ValueError, match="'tset': expected one of train, evaluation, test"):
        small(folder).generate([21], ("tset",))
    with pytest.raises(ValueError, match="'tset': expected one of train, evaluation, test"):
        small(folder).mazes("tset", 21)
    assert not folder.exists(), "nothing is written"


def test_manifest_tells_every_file_by_its_hash_and_is_the_same_for_the_same_mazes(tmp_path):
    manifests = []
    for folder in (tmp_path / "one", tmp_path / "two"):
        made = MazeStore(folder, counts={"train": 3, "evaluation": 1, "test": 2})
        made.generate([5, 7], ("train", "test"), workers=1)
        manifests.append(json.loads((folder / "manifest.json").read_text()))
        for name, entry in manifests[-1]["files"].items():
            content = (folder / name).read_bytes()
            assert entry["sha256"] == hashlib.sha256(content).hexdigest() and entry["bytes"] == len(content)
    assert manifests[0] == manifests[1]
    assert sorted(manifests[0]["files"]) == ["test/5.npz", "test/7.npz", "train/5.npz", "train/7.npz"]
    assert manifests[0]["files"]["train/5.npz"]["mazes"] == 3


def test_a_cluster_makes_the_same_files_byte_by_byte(tmp_path):
    ray = pytest.importorskip("ray", reason='Ray is not installed: pip install "lrrt[sweep]"')
    here, there = small(tmp_path / "here"), small(tmp_path / "there")
    assert here.generate([7, 9], workers=1) == there.generate([7, 9], ray="local") == 6
    assert not ray.is_initialized(), "what was started is shut down"
    names = sorted(str(path.relative_to(here.folder)) for path in here.folder.rglob("*") if path.is_file())
    assert len(names) == 7
    for name in names:
        assert (here.folder / name).read_bytes() == (there.folder / name).read_bytes(), name
