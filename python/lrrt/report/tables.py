# SPDX-License-Identifier: BSD-3-Clause
"""The tables of a report, as data."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import PurePosixPath

import numpy as np

from lrrt.report.formatting import mean_and_deviation, median_and_quartiles, short_number
from lrrt.report.results import WITHIN_PERCENTS, Field, PlanResults, PredictResults, Run, pairs_of, values_of
from lrrt.report.statistics import quantile, ratios, wilson_interval

FIELDS: tuple[tuple[Field, str], ...] = (
    ("first", "first path, ms"),
    ("prediction", "prediction, ms"),
    ("search", "search, ms"),
    ("iterations", "iterations"),
    ("nodes", "nodes"),
    ("length", "length / optimum"),
)
GAINS: tuple[Field, ...] = ("first", "search", "iterations", "nodes", "cost_of_path")  #: needs no optimum
_MEANS: tuple[tuple[Field, str], ...] = (
    ("first", "first path, ms"),
    ("search", "search, ms"),
    ("iterations", "iterations"),
    ("nodes", "nodes"),
    ("checks", "motion checks"),
    ("length", "length / optimum"),
    ("clearance", "clearance"),
)
HARD_MS = 100.0  #: a query is hard for a planner that needs longer than this, prediction included
HARD_COLUMNS = (
    "solved",
    "without",
    "neither",
    "hard",
    "gain: 90 % have",
    "median",
    "10 % have",
    "easy",
    "cost, ms",
    "without, and prediction",
)


@dataclass(frozen=True)
class Table:
    """A table: the first column names the row, the others hold numbers."""

    title: str
    columns: tuple[str, ...]
    rows: list[tuple[str, ...]]
    note: str = ""
    best: frozenset[tuple[int, int]] = frozenset()  #: row and column of cells to set in bold


def success(runs: Sequence[Run]) -> str:
    """As in ``8/10 (49 to 94 %)``, with Wilson's 95 % interval."""
    solved = sum(run.solved for run in runs)
    low, high = wilson_interval(solved, len(runs))
    return f"{solved}/{len(runs)} ({100 * low:.0f} to {100 * high:.0f} %)"


def medians_table(results: PlanResults, group: str) -> Table:
    """Success, and median and quartiles of everything that is measured."""
    rows = [
        (name, success(runs), *(median_and_quartiles(values_of(runs, field)) for field, _ in FIELDS))
        for name, runs in results.rows(group).items()
    ]
    return Table(
        "Median [quartiles]",
        ("planner", "solved (95 % interval)", *(title for _, title in FIELDS)),
        rows,
        "Over the solved runs of each planner. Where planners solved different runs, only the gains below compare like "
        "with like.",
    )


def means_table(results: PlanResults, group: str) -> Table:
    """Mean and sample standard deviation, as the paper tells them."""
    rows = [
        (name, *(mean_and_deviation(values_of(runs, field)) for field, _ in _MEANS))
        for name, runs in results.rows(group).items()
    ]
    return Table("Mean ± standard deviation", ("planner", *(title for _, title in _MEANS)), rows)


def times_within(runs: Sequence[Run], percent: int) -> list[float]:
    """When each run came so near to the optimum, of those that did; one of WITHIN_PERCENTS."""
    times = [run.within[WITHIN_PERCENTS.index(percent)] for run in runs]
    return [time for time in times if not math.isnan(time)]


def within_table(results: PlanResults, group: str) -> Table | None:
    """Median time to come near the optimum, and how many runs did; None when no run of any planner did."""
    rows = []
    any_run = False
    for name, runs in results.rows(group).items():
        cells = [name]
        for percent in WITHIN_PERCENTS:
            times = times_within(runs, percent)
            any_run = any_run or bool(times)
            cells.append(f"{short_number(quantile(times, 0.5))} ({len(times)}/{len(runs)})")
        rows.append(tuple(cells))
    if not any_run:
        return None
    return Table(
        "Time until the path is near the optimum, ms",
        ("planner", *(f"within {percent} %" for percent in WITHIN_PERCENTS)),
        rows,
        "Median over the runs that came so near; in brackets how many of all runs did.",
    )


def gains_of(pairs: Sequence[tuple[Run, Run]], field: Field) -> list[float]:
    """The first run's number divided by the second's, of each pair where that is a number."""
    return ratios((getattr(base, field), getattr(run, field)) for base, run in pairs)


def gains_table(results: PlanResults, group: str, baseline: str = "") -> Table | None:
    """A baseline's numbers divided by those of each planner that is compared with it; None where there is none.

    Args:
        results: what was measured.
        group: of maps.
        baseline: a row that others are compared with; the suite's by default.
    """
    baseline = baseline or results.baseline
    runs = results.rows(group)
    compared = [name for name in runs if name != baseline and results.baseline_of(name) == baseline]
    if baseline not in runs or not compared:
        return None
    titles = [title.removesuffix(", ms").removesuffix(" / optimum") for name, title in FIELDS if name != "prediction"]
    rows = []
    for name in compared:
        pairs = pairs_of(runs[baseline], runs[name])
        gains = [gains_of(pairs, field) for field in GAINS]
        rows.append((name, str(len(gains[0])), *(median_and_quartiles(gain, "×") for gain in gains)))
    return Table(
        f"Gain over {baseline}",
        ("planner", "pairs", *titles),
        rows,
        f"The number of {baseline} divided by the row's for the same map, query and seed, over runs that both "
        "solved: median [quartiles]. Above 1 the row is better.",
    )


def gains_tables(results: PlanResults, group: str) -> list[Table]:
    """One for every row that others are compared with."""
    tables = [gains_table(results, group, name) for name in results.rows(group)]
    return [table for table in tables if table is not None]


def hard_table(results: PlanResults, groups: Sequence[str]) -> Table | None:
    """What guidance is worth on the queries that are hard without it, and what it costs on the others.

    Args:
        results: what was measured.
        groups: of maps, taken together.

    Returns:
        A line for every guided planner whose baseline is unguided; None when there is none.
    """
    runs: dict[str, list[Run]] = {}
    for group in groups:
        for name, some in results.rows(group).items():
            runs.setdefault(name, []).extend(some)
    rows = [
        (name, *_hard_cells(runs[results.baseline_of(name)], others))
        for name, others in runs.items()
        if results.guided(name) and results.baseline_of(name) in runs and not results.guided(results.baseline_of(name))
    ]
    if not rows:
        return None
    return Table(
        "Hard and easy queries",
        ("planner", *HARD_COLUMNS),
        rows,
        f"Hard: what cost the unguided baseline more than {HARD_MS:g} ms, or came to no path; neither: what came to no "
        "path in both rows. Gain: what a hard query cost the baseline, divided by what it cost the row; failures count "
        "with the time they took. The last columns: medians over the easy queries, the row's prediction added to the "
        "baseline's time. Everything includes predictions.",
    )


def _hard_cells(baseline: list[Run], runs: list[Run]) -> tuple[str, ...]:
    by_key = {run.key: run for run in baseline}
    pairs = [(by_key[run.key], run) for run in runs if run.key in by_key]
    told = [(base, run) for base, run in pairs if base.solved or run.solved]
    hard = [(base, run) for base, run in told if not base.solved or base.cost > HARD_MS]
    easy = [(base, run) for base, run in pairs if base.solved and base.cost <= HARD_MS]
    gains = [base.cost / run.cost for base, run in hard]
    return (
        *(f"{sum(run.solved for run in some)}/{len(some)}" for some in (runs, baseline)),
        str(len(pairs) - len(told)),
        str(len(hard)),
        *(short_number(quantile(gains, share)) + "×" * bool(gains) for share in (0.1, 0.5, 0.9)),
        str(len(easy)),
        short_number(quantile([run.cost for _, run in easy], 0.5)),
        short_number(quantile([base.cost + run.prediction for base, run in easy], 0.5)),
    )


def group_tables(results: PlanResults, group: str) -> list[Table]:
    """All tables of a group that say something."""
    tables = [
        medians_table(results, group),
        hard_table(results, [group]),
        *gains_tables(results, group),
        within_table(results, group),
        means_table(results, group),
    ]
    return [table for table in tables if table is not None]


def settings_table(results: PlanResults) -> Table:
    """What each planner was set to."""
    rows: list[tuple[str, ...]] = [
        (
            s.name,
            s.planner,
            s.strategy if s.guided else "uniform (unguided)",
            f"{s.alpha:g}" if s.guided else "-",
            PurePosixPath(s.model).name if s.guided else "-",
            f"{s.range:g}" if s.range else "by the map",
            s.neighbors or "-",
            s.motion or "-",
            s.stop,
            f"{s.time_limit:g}",
        )
        for s in results.settings.values()
    ]
    columns = ("row", "planner", "samples", "α", "model", "range", "near nodes", "motion", "stop", "time limit, s")
    return Table("Planners", columns, rows)


_SETTING = ("model", "map, pixels", "input", "threads", "spinning", "batch")


def predict_table(results: PredictResults) -> Table:
    """Median and 95 % quantile of each stage of a prediction."""
    names = model_names([row.model for row in results.rows])
    rows = []
    for row in results.rows:
        stages = [
            f"{short_number(quantile(times, 0.5))} ({short_number(quantile(times, 0.95))})" for times in row.times.T
        ]
        total = float(np.sum(row.times[:, 3]))
        per_second = 1e3 * len(row.times) / total if total > 0 else math.inf
        pictures = ", ".join(f"{side}²" for side in row.sides) or "-"
        setting = (names[row.model], f"{row.size}²", pictures, str(row.threads), "on" if row.spinning else "off")
        rows.append((*setting, str(row.batch), *stages, short_number(per_second)))
    return Table(
        "Time of one prediction, ms: median (95 % are below)",
        (*_SETTING, "encode", "infer", "region", "all", "per second"),
        rows,
        "Per second: predictions, calls one after the other, all stages. Input: sides of the network's pictures. "
        "Spinning: idle threads stay awake. Batch: predictions of one call; infer and all are their shares of it.",
    )


def model_names(models: Sequence[str]) -> dict[str, str]:
    """File names instead of paths, where that leaves models different names."""
    short = {model: PurePosixPath(model).name for model in models}
    taken = list(short.values())
    return {model: name if taken.count(name) == 1 else model for model, name in short.items()}
