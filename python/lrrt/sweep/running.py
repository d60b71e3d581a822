# SPDX-License-Identifier: BSD-3-Clause
"""A sweep from its beginning to the merged result; goes on with what an interrupted one left."""

from __future__ import annotations

import glob
import hashlib
import json
import os
import uuid
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from lrrt.report.fields import ResultError, read_document
from lrrt.report.writing import document_text, write_file
from lrrt.sweep.cluster import map_on_ray
from lrrt.sweep.errors import ShardInterruptedError, SweepError
from lrrt.sweep.merge import Document, check_alike, check_document, merge
from lrrt.sweep.shards import Shard, ledger_of, run_shard

_FORMAT = "lrrt sweep 1"


@dataclass(frozen=True)
class Sweep:
    """A suite to run in shards."""

    suite: str  #: name or file, as lrrt_bench takes it
    result: str | os.PathLike[str]  #: file to write
    shards: int
    program: str = "lrrt_bench"  #: in PATH, or a path
    runs: int | None = None  #: these three replace what the suite says
    seed: int | None = None
    time_limit: float | None = None  #: seconds

    @property
    def options(self) -> tuple[str, ...]:
        """What is passed through to lrrt_bench."""
        given = {"--runs": self.runs, "--seed": self.seed, "--time-limit": self.time_limit}
        return tuple(word for name, value in given.items() if value is not None for word in (name, f"{value}"))


def run_sweep(
    sweep: Sweep,
    address: str | None = None,
    *,
    cpus: int = 1,
    exclusive: bool = False,
    progress: Callable[[int], None] = lambda done: None,
) -> Document:
    """Runs the shards of a suite that are missing on a Ray cluster, merges all of them and writes the result.

    Finished shards lie beside the result until it is written; an interrupted sweep goes on with them.

    Args:
        sweep: what to run.
        address: of the cluster; see ``map_on_ray``, as for ``cpus`` and ``exclusive``.
        progress: is called with the number of shards that are finished, each time it changes.

    Raises:
        SweepError: lrrt_bench refuses, shards do not fit together, or files of another sweep are in the way.
        ClusterError: Ray is not there, or workers die again and again.
    """
    if sweep.shards < 1:
        raise SweepError(f"{sweep.shards} shards: expected at least 1")
    shards = _shards(sweep, _token(sweep))
    try:
        documents = {shard.file.name: _read(shard.file) for shard in shards if shard.file.exists()}
        progress(len(documents))
        missing = [shard for shard in shards if shard.file.name not in documents]
        for shard, text in _made(missing, address, cpus, exclusive):
            _keep(shard, text, documents)
            progress(len(documents))
        document = merge(documents)
        write_file(_absolute(sweep), document_text(document))
    except BaseException:
        if not _left(sweep):
            ledger_of(_absolute(sweep)).unlink(missing_ok=True)  # nothing to go on with
        raise
    _remove_traces(shards)
    return document


def finished_shards(sweep: Sweep) -> int:
    """How many shards of a sweep lie beside its result."""
    return sum(shard.file.exists() for shard in _shards(sweep, ""))


def _made(missing: list[Shard], address: str | None, cpus: int, exclusive: bool) -> Iterator[tuple[Shard, str]]:
    if not missing:
        return iter(())  # no need to start Ray
    again_on = (ShardInterruptedError,)
    return map_on_ray(run_shard, missing, address, cpus=cpus, exclusive=exclusive, again_on=again_on)


def _keep(shard: Shard, text: str, documents: dict[str, Document]) -> None:
    """Writes a finished shard, unless it does not fit those that are there."""
    document = _parsed(shard.file, text)
    try:
        for name in list(documents)[:1]:
            check_alike(name, documents[name], shard.file.name, document)
    except SweepError:
        shard.file.unlink(missing_ok=True)  # the worker may have left it
        raise
    write_file(shard.file, text)
    documents[shard.file.name] = document


def _absolute(sweep: Sweep) -> Path:
    return Path(os.path.abspath(sweep.result))


def _shards(sweep: Sweep, token: str) -> list[Shard]:
    first = Shard(1, sweep.shards, sweep.suite, sweep.program, sweep.options, _absolute(sweep), Path.cwd(), token)
    return [replace(first, number=number) for number in range(1, sweep.shards + 1)]


def _token(sweep: Sweep) -> str:
    """Begins a sweep, or finds the one that was begun with the same command; what workers know its folder by."""
    ledger = ledger_of(_absolute(sweep))
    request = {"format": _FORMAT, "suite": sweep.suite, "shards": sweep.shards, "options": list(sweep.options)}
    request["checksum"] = _checksum(sweep.suite)
    if ledger.exists():
        begun = _ledger(ledger)
        token = begun.pop("token", None)
        if begun != request or not isinstance(token, str):
            raise SweepError(
                f"{ledger}: was begun with another suite, number of shards, --runs, --seed or --time-limit; give the "
                f"command that began it to go on, or remove it and {_traces(sweep)} to begin anew"
            )
        return token
    left = _left(sweep)
    if left:
        raise SweepError(f"{left[0]}: was left by another sweep; remove {_traces(sweep)}, or give another --json")
    token = uuid.uuid4().hex
    write_file(ledger, json.dumps(request | {"token": token}, indent=1) + "\n")
    return token


def _ledger(path: Path) -> dict[str, Any]:
    try:
        begun = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        begun = None
    return begun if isinstance(begun, dict) else {}


def _checksum(suite: str) -> str:
    """Of the suite's file, so that a sweep does not go on with another text; empty for a suite that ships."""
    try:
        return hashlib.sha256(Path(suite).read_bytes()).hexdigest()
    except OSError:
        return ""


def _traces(sweep: Sweep) -> str:
    return f"{_absolute(sweep).name}.shard-*"


def _left(sweep: Sweep) -> list[Path]:
    """Files of shards, finished or not."""
    return sorted(_absolute(sweep).parent.glob(f"{glob.escape(_absolute(sweep).name)}.shard-*"))


def _read(file: Path) -> Document:
    try:
        return check_document(file.name, read_document(file))
    except (ResultError, SweepError) as error:
        raise SweepError(f"{error}; remove {file} to run this shard again") from error


def _parsed(file: Path, text: str) -> Document:
    try:
        document = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise SweepError(f"{file}: is not JSON ({error}); expected what lrrt_bench --json writes") from error
    return check_document(file.name, document)


def _remove_traces(shards: list[Shard]) -> None:
    """What only an interrupted sweep needs; the ledger last."""
    for shard in shards:
        shard.file.unlink(missing_ok=True)
        shard.part.unlink(missing_ok=True)
    ledger_of(shards[0].result).unlink(missing_ok=True)
