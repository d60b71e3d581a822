# SPDX-License-Identifier: BSD-3-Clause
"""The queries that ``lrrt_bench --problems FOLDER`` wrote, read and checked."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from lrrt.report.fields import Fields, ResultError, is_number, read_object
from peers.validity import PictureError, read_free

RANGE_PIXELS = 6.0  #: longest extension where the suite leaves it to lrrt; what the paper took
STOPS = ("first", "limit")

Point = tuple[float, float]


@dataclass(frozen=True)
class Problem:
    """One query. Points are pixels (x right, y down), lengths map units."""

    group: str
    map: str
    query: str
    picture: Path
    resolution: float  #: map units a pixel
    start: Point
    goal: Point
    optimum: float | None  #: length of the shortest path, where it is known


@dataclass(frozen=True)
class Setting:
    """How a planner is set. Lengths are map units."""

    range: float  #: 0: RANGE_PIXELS
    goal_bias: float
    goal_tolerance: float
    stop: str  #: first, factor or limit
    time_limit: float  #: seconds


@dataclass(frozen=True)
class Problems:
    """A folder of problems with the suite that they come from."""

    folder: Path
    suite: dict[str, Any]
    runs: int
    seed: int
    problems: list[Problem]
    baseline: Setting
    unguided: dict[str, Setting]  #: rows of the suite without guidance, by planner

    def setting(self, kind: str) -> Setting:
        """How the suite sets a planner: as in its row without guidance; else as in its baseline."""
        return self.unguided.get(kind, self.baseline)

    def checksums(self) -> dict[str, str]:
        """What the pictures hold, by map: a run goes on only with the same ones."""
        return {p.map: hashlib.sha256(p.picture.read_bytes()).hexdigest()[:16] for p in self.problems}


def read_problems(folder: Path) -> Problems:
    """Reads ``problems.json`` and looks at every picture.

    Raises:
        ResultError: names the file, the field and what was expected.
    """
    document = read_object(folder / "problems.json", "lrrt_bench --problems")
    suite = document.child("suite")
    rows = suite.children("planners", "a list of planners")
    baseline = next((row for row in rows if row.text("name") == suite.text("baseline")), None)
    if baseline is None:
        raise suite.refuse("baseline", "the name of one of the planners")
    unguided = [row for row in rows if row.text("strategy") == "uniform"]
    problems = [_problem(fields, folder) for fields in document.children("problems", "a list of queries")]
    return Problems(
        folder=folder,
        suite=document.raw("suite"),
        runs=_at_least(suite, "runs", 1),
        seed=_at_least(suite, "seed", 0),
        problems=_with_pictures(problems),
        baseline=_setting(baseline),
        # The first row of a planner is meant where there are several.
        unguided={row.text("planner"): _setting(row) for row in reversed(unguided)},
    )


def _with_pictures(problems: list[Problem]) -> list[Problem]:
    for picture in dict.fromkeys(problem.picture for problem in problems):
        try:
            read_free(picture)
        except PictureError as error:
            raise ResultError(str(error)) from error
    return problems


def _problem(fields: Fields, folder: Path) -> Problem:
    if "headings" in fields:
        raise fields.refuse("headings", "none: these planners take points through the plane; choose such a suite")
    optimum = fields.number_or_nan("optimum")
    return Problem(
        group=fields.text("group"),
        map=fields.text("map"),
        query=fields.text("query"),
        picture=folder / fields.text("picture"),
        resolution=_positive(fields, "resolution"),
        start=_point(fields, "start_pixel"),
        goal=_point(fields, "goal_pixel"),
        optimum=optimum if optimum > 0 else None,
    )


def _setting(row: Fields) -> Setting:
    stop = row.text("stop")
    if stop not in (*STOPS, "factor"):
        raise row.refuse("stop", "'first', 'factor' or 'limit'")
    return Setting(
        range=row.number("range"),
        goal_bias=row.number("goal_bias"),
        goal_tolerance=row.number("goal_tolerance"),
        stop=stop,
        time_limit=_positive(row, "time_limit"),
    )


def _point(fields: Fields, key: str) -> Point:
    value = fields.raw(key) if key in fields else None
    if not (isinstance(value, list) and len(value) == 2 and all(map(is_number, value))):
        raise fields.refuse(key, "[x, y] in pixels")
    return float(value[0]), float(value[1])


def _at_least(fields: Fields, key: str, least: int) -> int:
    value = fields.whole(key)
    if value < least:
        raise fields.refuse(key, f"a whole number, at least {least}")
    return value


def _positive(fields: Fields, key: str) -> float:
    value = fields.number(key)
    if not value > 0:
        raise fields.refuse(key, "a number above 0")
    return value
