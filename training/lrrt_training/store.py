# SPDX-License-Identifier: BSD-3-Clause
"""Mazes on disk: one small file for each split and level, bits packed at block resolution."""

from __future__ import annotations

import hashlib
import json
import os
import zipfile
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from multiprocessing import get_context
from pathlib import Path
from typing import NamedTuple

import numpy as np
from rich.progress import Progress

from . import mazes

SPLITS = ("train", "evaluation", "test")
DEFAULT_COUNTS = {"train": 6000, "evaluation": 1000, "test": 1000}  #: mazes per level, as in the paper
_FORMAT = 1


def write_text(path: Path, text: str) -> None:
    """Writes a text under a temporary name, then renames it: the file is the old one or the new one, never half."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}")
    temporary.write_text(text)
    os.replace(temporary, path)


def check_split(split: str) -> None:
    """Raises ValueError unless there is such a split."""
    if split not in SPLITS:
        raise ValueError(f"split {split!r}: expected one of {', '.join(SPLITS)}")


def pack(occupied: np.ndarray) -> np.ndarray:
    """(N, m, m) bool → (N, ceil(m²/8)) uint8."""
    return np.packbits(occupied.reshape(len(occupied), -1), axis=1)


def unpack(bits: np.ndarray, level: int) -> np.ndarray:
    """One packed maze → (level, level) bool."""
    return np.unpackbits(bits, count=level * level).reshape(level, level).astype(bool)


class LevelJob(NamedTuple):
    """The mazes of one file."""

    split: str
    level: int  #: blocks a side
    count: int
    seed: int
    braided_share: float


def generate_level(job: LevelJob) -> np.ndarray:
    """``count`` packed mazes; maze i depends on (seed, split, level, i) alone, so that splits never share a seed."""
    parts = []
    for i in range(job.count):
        rng = np.random.default_rng([job.seed, SPLITS.index(job.split), job.level, i])
        parts.append(np.packbits(mazes.random_maze(rng, job.level, job.braided_share)))
    return np.stack(parts)


def _made_by_processes(jobs: list[LevelJob], workers: int) -> Iterator[tuple[LevelJob, np.ndarray]]:
    """Files as they are finished."""
    # Spawned, not forked: a fork copies the locks that other threads hold (progress bar, PyTorch, ONNX Runtime), and
    # may wait for one of them for ever.
    with ProcessPoolExecutor(max_workers=workers, mp_context=get_context("spawn")) as pool:
        pending = {pool.submit(generate_level, job): job for job in jobs}
        for future in as_completed(pending):
            yield pending.pop(future), future.result()


def _made_on_ray(jobs: list[LevelJob], address: str) -> Iterator[tuple[LevelJob, np.ndarray]]:
    from lrrt.sweep import map_on_ray

    return map_on_ray(generate_level, jobs, address)


def _write(path: Path, **arrays) -> None:
    """Writes an npz under a temporary name, then renames it: a file of the store is whole or absent."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}")
    with open(temporary, "wb") as file:
        np.savez(file, **arrays)
    os.replace(temporary, path)


class MazeStore:
    """Folder of maze files ``<split>/<level>.npz``.

    Args:
        folder: where the files lie.
        seed: seed of all mazes.
        counts: mazes per level for each split.
        braided_share: share of the mazes that get loops.
    """

    def __init__(
        self,
        folder: str | Path,
        seed: int = 1,
        counts: dict[str, int] | None = None,
        braided_share: float = 0.25,
    ) -> None:
        self.folder = Path(folder)
        self.seed = seed
        self.counts = {**DEFAULT_COUNTS, **(counts or {})}
        self.braided_share = braided_share
        self._cache: dict[tuple[str, int], np.ndarray] = {}

    def path(self, split: str, level: int) -> Path:
        return self.folder / split / f"{level}.npz"

    def _settings(self, split: str) -> np.ndarray:
        return np.array([_FORMAT, self.seed, self.counts[split], round(1000 * self.braided_share)])

    def _load(self, split: str, level: int) -> np.ndarray | None:
        """The packed mazes, or None where the file is absent, broken or made with other settings."""
        try:
            with np.load(self.path(split, level), allow_pickle=False) as file:
                if not np.array_equal(file["settings"], self._settings(split)):
                    return None
                return file["mazes"]
        except (OSError, EOFError, KeyError, ValueError, zipfile.BadZipFile):
            return None

    def mazes(self, split: str, level: int) -> np.ndarray:
        """(N, bytes) packed mazes of one level; ``unpack`` opens one."""
        check_split(split)
        key = (split, level)
        if key not in self._cache:
            bits = self._load(split, level)
            if bits is None:
                raise FileNotFoundError(
                    f"{self.path(split, level)}: no mazes of level {level} with seed {self.seed} and "
                    f"{self.counts[split]} mazes a level; run 'python -m lrrt_training generate' first"
                )
            self._cache[key] = bits
        return self._cache[key]

    def generate(
        self, levels: list[int], splits: tuple[str, ...] = SPLITS, workers: int = 2, ray: str | None = None
    ) -> int:
        """Makes every file that is missing, with a progress bar; returns how many it made.

        Args:
            levels: blocks a side.
            splits: of ``SPLITS``.
            workers: processes on this machine.
            ray: address of a Ray cluster that makes the mazes instead, ``local`` for this machine; see
                ``lrrt.sweep.map_on_ray``. This process writes the files, the same byte by byte.
        """
        for split in splits:
            check_split(split)
        for level in levels:
            mazes.check_level(level)
        missing = [(s, m) for s in splits for m in sorted(set(levels)) if self._load(s, m) is None]
        if not missing:
            return 0
        jobs = [LevelJob(s, m, self.counts[s], self.seed, self.braided_share) for s, m in missing]
        with Progress() as progress:
            task = progress.add_task("mazes", total=sum(job.count for job in jobs))
            for job, bits in _made_by_processes(jobs, workers) if ray is None else _made_on_ray(jobs, ray):
                self._save(job, bits)
                progress.advance(task, job.count)
        self.write_manifest()
        return len(jobs)

    def _save(self, job: LevelJob, bits: np.ndarray) -> None:
        path = self.path(job.split, job.level)
        path.parent.mkdir(parents=True, exist_ok=True)
        _write(path, mazes=bits, settings=self._settings(job.split))

    def write_manifest(self) -> None:
        """Enters every file of the store into ``manifest.json``: sha256, bytes, mazes, and the settings of all."""
        files = {}
        for path in sorted(self.folder.glob("*/*.npz")):
            content = path.read_bytes()
            split = path.parent.name
            files[f"{split}/{path.name}"] = {
                "sha256": hashlib.sha256(content).hexdigest(),
                "bytes": len(content),
                "mazes": self.counts.get(split, 0),
            }
        manifest = {"format": _FORMAT, "seed": self.seed, "braided_share": self.braided_share, "files": files}
        write_text(self.folder / "manifest.json", json.dumps(manifest, indent=1) + "\n")
