# SPDX-License-Identifier: BSD-3-Clause
"""Result files of ``lrrt_bench``, read and checked: runs by group and planner, and the pairs that both solved."""

from __future__ import annotations

import json
import math
import os
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Literal

import numpy as np
import numpy.typing as npt

from lrrt.report.fields import Fields, read_object

FORMAT = "lrrt_bench 1"
WITHIN_PERCENTS = (10, 5, 2, 1)  #: how near to the optimum; the benchmark program's steps
Field = Literal["first", "search", "prediction", "iterations", "nodes", "checks", "cost_of_path", "length", "clearance"]


@dataclass(frozen=True)
class Run:
    """One run of one planner on one query; nan for what it does not have. Times are milliseconds."""

    group: str
    map: str
    query: str
    planner: str
    seed: int
    solved: bool
    iterations: float  #: of the whole run
    nodes: float  #: of the whole run
    checks: float  #: motions checked in the whole run
    clearance: float  #: mean along the last path, map units
    prediction: float  #: encode, infer and region
    total: float  #: of the whole call
    first: float  #: from the call to the first path
    search: float  #: the planner's share of it
    cost_of_path: float  #: of the last path, map units
    length: float  #: the same, divided by the optimum
    within: tuple[float, ...]  #: from the call until the path was so near to the optimum, as WITHIN_PERCENTS
    history: npt.NDArray[np.float64]  #: (N, 2): milliseconds from the call, best length divided by the optimum

    @property
    def cost(self) -> float:
        """Milliseconds from the call to the first path; where none was found, of the whole call."""
        return self.first if self.solved else self.total

    @property
    def key(self) -> tuple[str, str, int]:
        """Runs of two planners with the same key are a pair."""
        return self.map, self.query, self.seed


@dataclass(frozen=True)
class Setting:
    """A planner of the suite with what sets it apart from the others."""

    name: str
    planner: str
    strategy: str
    alpha: float
    model: str
    range: float
    stop: str
    time_limit: float  #: seconds
    neighbors: str = ""  #: what finds the near nodes of its tree; empty in files that do not say
    motion: str = ""  #: how the robot moves; empty in files that do not say
    baseline: str = ""  #: name of the row that it is compared with; empty for the suite's

    @property
    def guided(self) -> bool:
        """Whether a region guides it; α and model mean nothing otherwise."""
        return self.strategy != "uniform"


@dataclass(frozen=True)
class Maze:
    """Where a group's maps are generated mazes: their size."""

    level: int  #: blocks a side
    pixels: int  #: side of the map
    kind: str  #: everything else; sizes are only compared between mazes of one kind
    braid: float  #: share of the dead ends that were opened; above 0 there are loops


@dataclass(frozen=True)
class Head:
    """What a file says of itself."""

    path: Path
    title: str
    versions: dict[str, str]
    machine: dict[str, str]
    started: str  #: UTC; empty where the file does not say
    command: str = ""  #: makes the file again; empty where lrrt_bench wrote it and can replay it

    @property
    def name(self) -> str:
        """The file's name without its endings: ``paper`` of ``paper.json.gz``."""
        return stem(self.path)


@dataclass(frozen=True)
class PlanResults:
    """A file of kind plan."""

    head: Head
    baseline: str
    settings: dict[str, Setting]  #: by name
    mazes: dict[str, Maze]  #: by group, for those that are mazes
    runs: list[Run]

    def groups(self) -> list[str]:
        """Groups of maps in the order of the file."""
        return list(self._index)

    def planners(self) -> list[str]:
        """Planners in the order of the file."""
        return list(dict.fromkeys(run.planner for run in self.runs))

    def baseline_of(self, planner: str) -> str:
        """The row that a planner's row is compared with; a baseline's may be its own."""
        setting = self.settings.get(planner)
        return (setting.baseline if setting else "") or self.baseline

    def guided(self, planner: str) -> bool:
        """Whether a region guides a planner's row."""
        setting = self.settings.get(planner)
        return setting is not None and setting.guided

    def rows(self, group: str) -> dict[str, list[Run]]:
        """The runs of a group by planner."""
        return self._index[group]

    @cached_property
    def _index(self) -> dict[str, dict[str, list[Run]]]:
        index: dict[str, dict[str, list[Run]]] = {}
        for run in self.runs:
            index.setdefault(run.group, {}).setdefault(run.planner, []).append(run)
        return index


@dataclass(frozen=True)
class Predictions:
    """Times of one model on maps of one size with one setting of its threads."""

    model: str
    size: int  #: side of the maps, pixels
    sides: tuple[int, ...]  #: of the network's pictures, pixels; none in files of older versions
    threads: int
    spinning: bool
    batch: int  #: predictions of one call
    times: npt.NDArray[np.float64]  #: (N, 4) milliseconds: encode, infer, region, all


@dataclass(frozen=True)
class PredictResults:
    """A file of kind predict."""

    head: Head
    rows: list[Predictions]


def load(path: str | os.PathLike[str]) -> PlanResults | PredictResults:
    """Reads and checks a result file.

    Raises:
        ResultError: names the file, the field and what was expected.
    """
    document = read_object(Path(path))
    if document.text("format") != FORMAT:
        raise document.refuse("format", f"'{FORMAT}', which lrrt_bench --json writes")
    suite = document.child("suite")
    head = _head(document, suite, Path(path))
    rows = document.children("rows", "a list of at least one run")
    kind = suite.text("kind")
    if kind == "predict":
        return PredictResults(head, [_predictions(row) for row in rows])
    if kind != "plan":
        raise suite.refuse("kind", "'plan' or 'predict'")
    settings = {s.name: s for s in map(_setting, suite.children("planners", "a list of planners"))}
    return PlanResults(head, suite.text("baseline"), settings, _mazes(suite), [_run(row) for row in rows])


def stem(path: Path) -> str:
    """A result file's name without ``.json`` or ``.json.gz``."""
    return path.with_suffix("").stem if path.suffix == ".gz" else path.stem


def values_of(runs: list[Run], field: Field) -> list[float]:
    """One field of the solved runs that have it."""
    values = [float(getattr(run, field)) for run in runs if run.solved]
    return [value for value in values if not math.isnan(value)]


def pairs_of(baseline: list[Run], runs: list[Run]) -> list[tuple[Run, Run]]:
    """Runs with the same map, query and seed that both solved: the baseline's and the other."""
    by_key = {run.key: run for run in baseline}
    pairs = [(by_key[run.key], run) for run in runs if run.key in by_key]
    return [(base, run) for base, run in pairs if base.solved and run.solved]


def _head(document: Fields, suite: Fields, path: Path) -> Head:
    versions, machine = document.child("versions"), document.child("machine")
    named = {key: versions.text(key) for key in versions}
    about = {key: machine.text(key) for key in ("processor", "system") if key in machine}
    if "cores" in machine:
        about["cores"] = str(machine.whole("cores"))
    title = suite.text("title", "") or stem(path)
    named = {key: version for key, version in named.items() if version}
    return Head(path, title, named, about, document.text("started", ""), document.text("command", ""))


def _setting(fields: Fields) -> Setting:
    return Setting(
        name=fields.text("name"),
        planner=fields.text("planner"),
        strategy=fields.text("strategy"),
        alpha=fields.number("alpha"),
        model=fields.text("model"),
        range=fields.number("range"),
        stop=fields.text("stop"),
        time_limit=fields.number("time_limit"),
        neighbors=fields.text("neighbors", ""),
        motion=fields.text("motion", ""),
        baseline=fields.text("baseline", ""),
    )


def _mazes(suite: Fields) -> dict[str, Maze]:
    mazes = {}
    for source in suite.children("maps", "a list of maps"):
        if source.text("kind") == "maze":
            others = {"algorithm", "braid", "queries"} & set(source)
            kind = json.dumps({key: source.raw(key) for key in sorted(others)}, sort_keys=True)
            braid = source.number("braid") if "braid" in source else 0.0
            mazes[source.text("name")] = Maze(source.whole("level"), source.whole("pixels"), kind, braid)
    return mazes


def _run(row: Fields) -> Run:
    times = row.child("times_ms")
    solved = row.flag("solved")
    first, search = (row.number(key) if solved else math.nan for key in ("first_ms", "search_ms"))
    optimum = row.number_or_nan("optimum")
    within = row.child("within_ms") if "within_ms" in row else Fields({}, "")
    return Run(
        group=row.text("group"),
        map=row.text("map"),
        query=row.text("query"),
        planner=row.text("planner"),
        seed=row.whole("seed"),
        solved=solved,
        iterations=float(row.whole("iterations")),
        nodes=float(row.whole("nodes")),
        checks=row.number_or_nan("motion_checks"),
        clearance=row.child("clearance").number_or_nan("mean") if "clearance" in row else math.nan,
        prediction=sum(times.number(stage) for stage in ("encode", "infer", "region")),
        total=times.number("total"),
        first=first,
        search=search,
        cost_of_path=row.number("length") if solved else math.nan,
        length=row.number("length") / optimum if solved and optimum > 0 else math.nan,
        within=tuple(within.number_or_nan(str(percent)) for percent in WITHIN_PERCENTS),
        history=_history(row, first - search, optimum) if solved else np.empty((0, 2)),
    )


def _history(row: Fields, before_search: float, optimum: float) -> npt.NDArray[np.float64]:
    steps = np.asarray(row.matrix("history", 3, "a list of [milliseconds, iteration, length]"), dtype=np.float64)
    ratio = steps[:, 2] / optimum if optimum > 0 else np.full(len(steps), math.nan)
    return np.column_stack((before_search + steps[:, 0], ratio))


def _predictions(row: Fields) -> Predictions:
    times = row.matrix("times", 4, "a list of [encode, infer, region, all], milliseconds")
    return Predictions(
        model=row.text("model"),
        size=row.whole("size"),
        sides=tuple(row.wholes("input_sides")) if "input_sides" in row else (),
        threads=row.whole("threads"),
        spinning=row.flag("spinning"),
        batch=row.whole("batch") if "batch" in row else 1,
        times=np.asarray(times, dtype=np.float64),
    )
