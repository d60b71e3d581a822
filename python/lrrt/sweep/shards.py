# SPDX-License-Identifier: BSD-3-Clause
"""One shard of a suite, run where a worker is."""

from __future__ import annotations

import json
import os
import platform
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from lrrt.sweep import leash
from lrrt.sweep.errors import ShardInterruptedError, SweepError

_INTERRUPTED = 130  # exit code of lrrt_bench
_OF_ANOTHER_RUN = "was begun with another"  # how lrrt_bench refuses a part file that it cannot go on with


@dataclass(frozen=True)
class Shard:
    """A part of a suite, with all that a worker needs to know."""

    number: int  #: from 1
    of: int
    suite: str  #: name or file, as lrrt_bench takes it
    program: str  #: lrrt_bench: a name of PATH or a path
    options: tuple[str, ...]  #: for lrrt_bench
    result: Path  #: of the whole sweep, absolute
    folder: Path  #: where the command was given; relative paths count from there
    token: str  #: of this sweep

    def __str__(self) -> str:
        return f"shard {self.number} of {self.of}"

    @property
    def file(self) -> Path:
        """Its own result; while it is made there is a .part beside it."""
        return self.result.with_name(f"{self.result.name}.shard-{self.number}-of-{self.of}.json")

    @property
    def part(self) -> Path:
        """Finished rows of a shard that is not finished."""
        return part_of(self.file)


def part_of(file: Path) -> Path:
    """Where lrrt_bench keeps the rows of a result that is not finished."""
    return file.with_name(f"{file.name}.part")


def ledger_of(result: Path) -> Path:
    """What a sweep was begun with; lies beside the result until the sweep is done."""
    return result.with_name(f"{result.name}.sweep")


def run_shard(shard: Shard) -> str:
    """Runs a shard, or goes on with it, and returns its result file's text.

    Raises:
        SweepError: lrrt_bench is not there or refuses, or a file cannot be read or written; names the machine and says
            what lrrt_bench said.
        ShardInterruptedError: something ended it.
    """
    try:
        return _result_of(shard)
    except (OSError, UnicodeDecodeError) as error:
        raise SweepError(
            f"{shard} on {platform.node()}: {error}; expected files that may be read and written"
        ) from error


def _result_of(shard: Shard) -> str:
    if _sees_the_sweep(shard):
        if shard.file.exists():  # its worker died after the last row
            return shard.file.read_text(encoding="utf-8")
        return _run(shard, shard.file)
    with tempfile.TemporaryDirectory(prefix="lrrt-sweep-") as folder:
        return _run(shard, Path(folder) / shard.file.name)


def _sees_the_sweep(shard: Shard) -> bool:
    """Whether the result's folder here is the very folder of the one who sweeps, not another of the same name."""
    try:
        return bool(json.loads(ledger_of(shard.result).read_text(encoding="utf-8"))["token"] == shard.token)
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return False


def _run(shard: Shard, file: Path) -> str:
    begun = part_of(file).exists()
    said = _called(shard, file)
    if said is not None and begun and _OF_ANOTHER_RUN in said:
        # Begun on another kind of machine: the rows of one shard are to come from one.
        part_of(file).unlink(missing_ok=True)
        said = _called(shard, file)
    if said is not None:
        raise SweepError(f"{shard} on {platform.node()}: {shard.program} failed: {said}")
    return file.read_text(encoding="utf-8")


def _called(shard: Shard, file: Path) -> str | None:
    """Runs lrrt_bench; None when it was done, otherwise what it said."""
    words = ["--suite", shard.suite, "--shard", f"{shard.number}/{shard.of}", "--json", str(file), *shard.options]
    held = [sys.executable, "-I", leash.__file__, str(os.getpid())]
    run = subprocess.run(
        [*held, _program(shard), *words],
        cwd=shard.folder if shard.folder.is_dir() else None,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        encoding="utf-8",
        errors="replace",
    )
    if run.returncode == 0:
        return None
    if run.returncode < 0 or run.returncode == _INTERRUPTED:
        raise ShardInterruptedError(f"{shard} on {platform.node()}: {shard.program} was ended ({run.returncode})")
    lines = [line for line in run.stderr.splitlines() if line and not line.startswith("note:")]
    return "; ".join(lines[-3:]).removeprefix("error: ") or f"exit code {run.returncode}"


def _program(shard: Shard) -> str:
    """The program's path; a relative one counts from where the command was given."""
    name = str(shard.folder / shard.program) if os.sep in shard.program else shard.program
    found = shutil.which(name)
    if found is None:
        raise SweepError(
            f"{shard} on {platform.node()}: there is no program '{name}'; expected lrrt_bench at the same place on "
            "every machine: in PATH, or where --bench says ('make build' makes build/release/bench/lrrt_bench)"
        )
    return found
