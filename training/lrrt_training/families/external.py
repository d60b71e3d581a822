# SPDX-License-Identifier: BSD-3-Clause
"""Maps of other projects, where their files are at hand; nothing depends on them."""

from __future__ import annotations

import zipfile
import zlib
from itertools import zip_longest
from pathlib import Path

import numpy as np

MPD_FILE = "mpd_201x201_free_1bit.npz"
MPD_ENVIRONMENTS = ("bugtrap_forest", "forest", "gaps_and_forest", "multiple_bugtraps")
MPD_SPLITS = {"train": "train", "evaluation": "validation", "test": "test"}
MPD_SIDE = 201
DUNGEON_FILE = "dungeon_train_480x640_1bit.npz"
DUNGEON_SHAPE = (480, 640)
DUNGEON_PERIOD = 20  # of so many maps, the first is for test, the second for evaluation
SPLITS = ("train", "evaluation", "test")

_UNREADABLE = (OSError, EOFError, KeyError, ValueError, zipfile.BadZipFile, zlib.error)


def _read(path: Path, keys: list[str], row_shape: tuple[int, ...], expected: str) -> dict[str, np.ndarray]:
    """Arrays of packed bits of an .npz file, checked.

    Raises:
        ValueError: the file cannot be read or holds something else.
    """
    try:
        with np.load(path, allow_pickle=False) as file:
            arrays = {key: file[key] for key in keys}
    except _UNREADABLE as error:
        raise ValueError(f"{path}: expected {expected}; {error}") from error
    for key, array in arrays.items():
        if array.dtype != np.uint8 or array.shape[1:] != row_shape:
            raise ValueError(f"{path}: expected {expected}; {key} is {array.dtype} of shape {array.shape}")
    return arrays


class _Mpd:
    """201×201 maps of four environments, which take turns; the file has splits of its own."""

    def __init__(self, path: Path) -> None:
        keys = [f"{environment}_{split}" for environment in MPD_ENVIRONMENTS for split in MPD_SPLITS.values()]
        packed = (MPD_SIDE**2 + 7) // 8
        self._arrays = _read(path, keys, (packed,), f"uint8 arrays (N, {packed}) {', '.join(keys)}")
        self._order = {split: self._turns(name) for split, name in MPD_SPLITS.items()}

    def _turns(self, split: str) -> list[tuple[str, int]]:
        """Key and row of every map of a split; an environment that has run out is passed over."""
        keys = [f"{environment}_{split}" for environment in MPD_ENVIRONMENTS]
        rounds = zip_longest(*([(key, row) for row in range(len(self._arrays[key]))] for key in keys))
        return [place for turn in rounds for place in turn if place is not None]

    def count(self, split: str) -> int:
        return len(self._order[split])

    def map(self, split: str, index: int) -> np.ndarray:
        key, row = self._order[split][index]
        free = np.unpackbits(self._arrays[key][row], count=MPD_SIDE**2)
        return free.reshape(MPD_SIDE, MPD_SIDE) == 0


class _Dungeon:
    """480×640 maps of caves and rooms. All of them together take 217 MB of memory."""

    def __init__(self, path: Path) -> None:
        row_shape = (DUNGEON_SHAPE[0], DUNGEON_SHAPE[1] // 8)
        expected = f"a uint8 array free_packbits (N, {row_shape[0]}, {row_shape[1]})"
        self._packed = _read(path, ["free_packbits"], row_shape, expected)["free_packbits"]
        rest = np.arange(len(self._packed)) % DUNGEON_PERIOD
        self._order = {"test": np.flatnonzero(rest == 0), "evaluation": np.flatnonzero(rest == 1)}
        self._order["train"] = np.flatnonzero(rest > 1)

    def count(self, split: str) -> int:
        return len(self._order[split])

    def map(self, split: str, index: int) -> np.ndarray:
        return np.unpackbits(self._packed[self._order[split][index]], axis=1) == 0


class ExternalMaps:
    """The data files of a folder, as far as they are there.

    Raises:
        ValueError: a file is there but broken.
    """

    def __init__(self, folder: str | Path) -> None:
        known = (("mpd", MPD_FILE, _Mpd), ("dungeon", DUNGEON_FILE, _Dungeon))
        paths = {name: (Path(folder) / file, source) for name, file, source in known}
        self._sources = {name: source(path) for name, (path, source) in paths.items() if path.is_file()}

    def names(self) -> list[str]:
        """The sources that are there."""
        return list(self._sources)

    def _source(self, name: str, split: str) -> _Mpd | _Dungeon:
        if name not in self._sources:
            raise ValueError(f"external maps {name!r}: expected one of {', '.join(self._sources) or '(no file found)'}")
        if split not in SPLITS:
            raise ValueError(f"split {split!r}: expected one of {', '.join(SPLITS)}")
        return self._sources[name]

    def count(self, name: str, split: str) -> int:
        """Number of maps of a source in a split."""
        return self._source(name, split).count(split)

    def map(self, name: str, split: str, index: int) -> np.ndarray:
        """Map ``index``, 0 to count - 1, as an (H, W) bool array, True = occupied."""
        source = self._source(name, split)
        if not 0 <= index < source.count(split):
            raise IndexError(f"external maps {name!r}, {split}: index {index} of {source.count(split)} maps")
        return source.map(split, int(index))
