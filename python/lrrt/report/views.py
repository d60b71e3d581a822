# SPDX-License-Identifier: BSD-3-Clause
"""Results as compact tables for documents: planners as rows, groups of maps as columns, one number in a cell.

The numbers are those of the report's tables, from the same functions.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from lrrt.report.fields import ResultError
from lrrt.report.formatting import short_number
from lrrt.report.results import WITHIN_PERCENTS, Field, PlanResults, PredictResults, Run, pairs_of, values_of
from lrrt.report.statistics import quantile
from lrrt.report.tables import FIELDS, GAINS, Table, gains_of, hard_table, predict_table, success, times_within

MOST_COLUMNS = 6  #: groups; where there are more, and more than planners, they become rows
_TITLES = dict(FIELDS)
_GAINS: dict[str, Field] = dict(zip(("first-path", "search", "iterations", "nodes", "length"), GAINS))


@dataclass(frozen=True)
class View:
    """A way to show a result as one table."""

    kind: str  #: of the results that it shows: plan or predict
    says: str  #: what the table tells
    make: Callable[[Any, str], Table]  #: from the results and the choice
    choices: tuple[str, ...] = ()  #: what may stand after a colon; the first where nothing does


@dataclass(frozen=True)
class _Cell:
    text: str
    value: float = math.nan
    share: float = 1.0  #: of the runs that the value speaks for


CellOf = Callable[[list[Run], list[Run]], _Cell]  #: from the runs of a planner and of the baseline in a group


def table_of(results: PlanResults | PredictResults, word: str, also: tuple[str, ...] = ()) -> Table:
    """The table that a word such as ``first-path`` or ``within:5`` asks for.

    Args:
        results: what to show.
        word: name of a view, and a choice after a colon.
        also: words that the caller knows besides, for the error.

    Raises:
        ResultError: no such view for these results; names those that there are.
    """
    kind = kind_of(results)
    name, colon, choice = word.partition(":")
    view = VIEWS.get(name)
    if view is None or view.kind != kind:
        known = ", ".join([*(name for name, view in VIEWS.items() if view.kind == kind), *also])
        raise ResultError(f"'{word}' is no view of a result of kind {kind}; expected one of {known}")
    if not colon and view.choices:
        choice = view.choices[0]
    elif colon and choice not in view.choices:
        known = ", ".join(f"{name}:{choice}" for choice in view.choices) or name
        raise ResultError(f"'{word}' is no view; expected one of {known}")
    return view.make(results, choice)


def kind_of(results: PlanResults | PredictResults) -> str:
    """What a suite calls the kind of its results."""
    return "predict" if isinstance(results, PredictResults) else "plan"


def group_labels(results: PlanResults) -> dict[str, str]:
    """Short names of the groups: ``25 blocks, loops`` where the program made the name up, the suite's own otherwise."""
    sides = {maze.pixels for maze in results.mazes.values()}
    labels = {}
    for group in results.groups():
        maze = results.mazes.get(group)
        if maze is None or not re.fullmatch(r"mazes of \d+×\d+ blocks on \d+ pixels", group):
            labels[group] = group
            continue
        words = [
            f"{maze.level} blocks",
            f"{maze.pixels} pixels" if len(sides) > 1 else "",
            "loops" if maze.braid > 0 else "",
        ]
        labels[group] = ", ".join(filter(None, words))
    return labels if len(set(labels.values())) == len(labels) else {group: group for group in labels}


def _medians(field: Field) -> Callable[[PlanResults, str], Table]:
    def cell(runs: list[Run], _: list[Run]) -> _Cell:
        median = quantile(values_of(runs, field), 0.5)
        return _counted(median, short_number(median), sum(run.solved for run in runs), len(runs))

    return lambda results, _: _compact(results, _TITLES[field], cell, min)


def _slowest(results: PlanResults, choice: str) -> Table:
    """The time below which so many of all runs had a path; a run without one took longer than any."""

    def cell(runs: list[Run], _: list[Run]) -> _Cell:
        times = sorted(run.first if run.solved else math.inf for run in runs)
        time = times[max(0, math.ceil(int(choice) / 100 * len(times)) - 1)]
        return _Cell(short_number(time), time) if math.isfinite(time) else _Cell("more runs failed")

    return _compact(results, f"{choice} % have a first path, ms", cell, min)


def _gain(results: PlanResults, choice: str) -> Table:
    field = _GAINS[choice]

    def cell(runs: list[Run], baseline: list[Run]) -> _Cell:
        gains = gains_of(pairs_of(baseline, runs), field)
        median = quantile(gains, 0.5)
        return _counted(median, short_number(median) + "×" * bool(gains), len(gains), len(runs))

    quantity = _TITLES[field].removesuffix(", ms") if field in _TITLES else choice
    baselines = {results.baseline_of(name) for name in results.planners()}
    who = results.baseline if len(baselines) == 1 else "the baseline's"
    return _compact(results, f"{quantity}, {who} ÷ the row's", cell, max, baseline=False)


def _within(results: PlanResults, choice: str) -> Table:
    def cell(runs: list[Run], _: list[Run]) -> _Cell:
        times = times_within(runs, int(choice))
        median = quantile(times, 0.5)
        return _counted(median, short_number(median), len(times), len(runs))

    return _compact(results, f"within {choice} %, ms", cell, min)


def _success(results: PlanResults, _: str) -> Table:
    return _compact(results, "solved (95 % interval)", lambda runs, _: _Cell(success(runs)), min)


def _hard(results: PlanResults, choice: str) -> Table:
    """Guided planners on all groups together, or on each."""
    parts = [results.groups()] if choice == "all" else [[group] for group in results.groups()]
    labels = group_labels(results)
    tables = [(labels[part[0]], hard_table(results, part)) for part in parts]
    made = [(label, table) for label, table in tables if table is not None]
    if not made:
        raise ResultError("'hard' compares guided planners with unguided baselines; the result has no such pair")
    first = made[0][1]
    if choice == "all":
        return first
    rows = [(label, *row) for label, table in made for row in table.rows]
    return Table(first.title, ("maps", *first.columns), rows, first.note)


def _predict(results: PredictResults, _: str) -> Table:
    """The report's table without settings that are the same in all rows."""
    table = predict_table(results)
    settings = table.columns.index("encode")
    shown = [j for j in range(len(table.columns)) if j >= settings or len({row[j] for row in table.rows}) > 1]
    rows = [tuple(row[j] for j in shown) for row in table.rows]
    return Table(table.title, tuple(table.columns[j] for j in shown), rows, table.note)


def _counted(value: float, text: str, count: int, total: int) -> _Cell:
    """A number and, where it does not speak for all runs, how many it speaks for."""
    words = text if count == total else f"{text} ({count} of {total})"
    return _Cell(words, value, count / total)


def _compact(
    results: PlanResults, title: str, cell: CellOf, better: Callable[..., float], baseline: bool = True
) -> Table:
    """One table of all groups and planners, the baseline among them or not, with the best of each group in bold."""
    groups = results.groups()
    planners = [name for name in results.planners() if baseline or name != results.baseline_of(name)]
    cells: dict[tuple[str, str], _Cell] = {}
    best: set[tuple[str, str]] = set()
    for group in groups:
        rows = results.rows(group)
        column = {name: cell(rows[name], rows.get(results.baseline_of(name), [])) for name in planners if name in rows}
        cells |= {(name, group): made for name, made in column.items()}
        best |= {(name, group) for name in _best(column, better)}
    labels = group_labels(results)
    if len(groups) > max(MOST_COLUMNS, len(planners)):
        grid = [[(name, group) for name in planners] for group in groups]
        heads, names = planners, [labels[group] for group in groups]
    else:
        grid = [[(name, group) for group in groups] for name in planners]
        heads, names = [labels[group] for group in groups], planners
    lines = [(name, *(cells.get(place, _Cell("")).text for place in line)) for name, line in zip(names, grid)]
    bold = {(i, j + 1) for i, line in enumerate(grid) for j, place in enumerate(line) if place in best}
    return Table(title, (title, *heads), lines, best=frozenset(bold))


def _best(column: dict[str, _Cell], better: Callable[..., float]) -> list[str]:
    """The planners with the best number among those that speak for the most runs; none where that is no contest."""
    known = {name: cell for name, cell in column.items() if not math.isnan(cell.value)}
    if len(known) < 2:
        return []
    most = max(cell.share for cell in known.values())
    rivals = {name: cell for name, cell in known.items() if cell.share == most}
    value = better(cell.value for cell in rivals.values())
    return [name for name, cell in rivals.items() if cell.value == value]


VIEWS: dict[str, View] = {
    "first-path": View(
        "plan", "milliseconds from the call to the first path, everything counted: median", _medians("first")
    ),
    "slowest": View("plan", "milliseconds after which 90 % of all runs had a path", _slowest, ("90", "100")),
    "search": View("plan", "the planner's share of that", _medians("search")),
    "iterations": View("plan", "iterations of the whole run: median", _medians("iterations")),
    "gain": View("plan", "the baseline's number divided by the row's, paired: median", _gain, tuple(_GAINS)),
    "within": View(
        "plan",
        "milliseconds until the path is within 2 % of the optimum: median",
        _within,
        tuple(str(percent) for percent in sorted(WITHIN_PERCENTS, key=lambda percent: percent != 2)),
    ),
    "success": View("plan", "how many runs found a path, with Wilson's 95 % interval", _success),
    "hard": View(
        "plan",
        "guided planners against unguided baselines: gains on the queries that cost these more than 100 ms, times on "
        "the others",
        _hard,
        ("all", "groups"),
    ),
    "predict": View("predict", "the stages of a prediction: median, and what 95 % are below", _predict),
}
