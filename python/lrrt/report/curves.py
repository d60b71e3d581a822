# SPDX-License-Identifier: BSD-3-Clause
"""Figures of lines: cost against time, success against time, growth with the size of the maps."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from lrrt.report.formatting import slug
from lrrt.report.results import Field, PlanResults, Run, values_of
from lrrt.report.statistics import quantile
from lrrt.report.style import Look, Picture, new_figure, panels, plain_axis, shown, side_legend, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_INSTANTS = 240  # at which cost is read off
_LEAST_CHANGE = 2e-3  # of a figure's height; a step that is smaller would not be seen
_GROWTH: tuple[tuple[Field, str], ...] = (
    ("prediction", "prediction, ms"),
    ("search", "search, ms"),
    ("first", "call to first path, ms"),
)


@styled
def cost_picture(results: PlanResults, group: str, looks: dict[str, Look]) -> Picture | None:
    """Best length so far over time, median and quartiles; None where no path was ever improved."""
    rows = results.rows(group)
    runs = [run for row in rows.values() for run in row]
    improved = any(len(run.history) > 1 for run in runs)
    if not improved or not any(np.isfinite(run.history[:, 1]).any() for run in runs):
        return None
    times = np.geomspace(*_span(runs), _INSTANTS)
    names = panels(list(rows))
    figure = new_figure(8.6, 3.5 * len(names))
    grid = figure.subplots(len(names), 1, squeeze=False, sharex=True, sharey=True)[:, 0]
    curves = {name: np.stack(costs_over_time(row, times)) for name, row in rows.items()}
    top = max([1.0, *(cost for curve in curves.values() for cost in curve[1:][np.isfinite(curve[1:])])])
    for axes, part in zip(grid, names):
        for name in part:
            steps = visible_steps(curves[name], _LEAST_CHANGE * (top - 1.0))
            _cost_line(axes, times[steps], curves[name][:, steps], shown(name), looks[name])
        axes.set(xscale="log", ylabel="length / optimum")
        axes.grid()
        side_legend(axes)
    grid[0].set_ylim(1.0, 1.0 + 1.06 * (top - 1.0))
    grid[0].set_xlim(times[0], times[-1])
    plain_axis(grid[0].xaxis, log=True)
    grid[-1].set_xlabel("time since the call, ms")
    return Picture(
        f"cost-{slug(group)}",
        "Cost against time",
        "Best length so far divided by the shortest: median and quartiles over all runs. A run without a path "
        "counts as endlessly long, so a line begins where half of the runs have a path.",
        figure,
    )


def _cost_line(
    axes: Axes, times: npt.NDArray[np.float64], curve: npt.NDArray[np.float64], label: str, look: Look
) -> None:
    lower, median, upper = curve
    # Where a quarter of the runs have no path yet, the band is open upwards.
    axes.fill_between(times, lower, np.minimum(upper, 1e3), step="post", color=look.colour, alpha=0.13, lw=0)
    median = np.where(np.isfinite(median), median, np.nan)
    axes.plot(times, median, drawstyle="steps-post", color=look.colour, linestyle=look.line, label=label)


def visible_steps(curves: npt.NDArray[np.float64], least: float) -> list[int]:
    """The columns at which any row differs by so much from the column kept before; the first and the last, too."""
    kept = [0]
    for column in range(1, curves.shape[1] - 1):
        before, now = curves[:, kept[-1]], curves[:, column]
        with np.errstate(invalid="ignore"):  # of endless costs
            if ((now != before) & ~(np.abs(now - before) < least)).any():
                kept.append(column)
    return [*kept, curves.shape[1] - 1]


def _span(runs: list[Run]) -> tuple[float, float]:
    """A time before the first path of any run, and one when all have ended."""
    firsts = [run.first for run in runs if run.solved]
    start = 0.85 * max(min(firsts), 1e-3)
    return start, max(2 * start, 1.03 * max(run.total for run in runs), 1.03 * max(firsts))


def costs_over_time(
    runs: list[Run], times: npt.NDArray[np.float64]
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Lower quartile, median and upper quartile of the best length / optimum at each time; inf before a path."""
    costs = np.full((len(runs), len(times)), math.inf)
    for cost, run in zip(costs, runs):
        if len(run.history):
            last = np.searchsorted(run.history[:, 0], times, side="right") - 1
            best = np.minimum.accumulate(run.history[:, 1])
            cost[last >= 0] = best[last[last >= 0]]
    costs = costs[~np.isnan(costs).any(axis=1)]  # runs whose optimum is unknown
    if not len(costs):
        nothing = np.full(len(times), math.nan)
        return nothing, nothing, nothing
    costs.sort(axis=0)
    lower, median, upper = (_column_quantile(costs, share) for share in (0.25, 0.5, 0.75))
    return lower, median, upper


def _column_quantile(ordered: npt.NDArray[np.float64], share: float) -> npt.NDArray[np.float64]:
    """Quantile of sorted columns; inf as soon as an infinite value takes part."""
    place = share * (len(ordered) - 1)
    below = ordered[math.floor(place)]
    above = ordered[math.ceil(place)]
    part = place - math.floor(place)
    with np.errstate(invalid="ignore"):
        between = below + part * (above - below)
    return np.where(np.isfinite(below) & np.isfinite(above), between, math.inf if part else below)


@styled
def success_picture(results: PlanResults, group: str, looks: dict[str, Look]) -> Picture | None:
    """Share of runs that have a path by a time; None where no run found one."""
    rows = results.rows(group)
    runs = [run for row in rows.values() for run in row]
    if not any(run.solved for run in runs):
        return None
    start, end = _span(runs)
    names = panels(list(rows))
    figure = new_figure(8.6, 3.2 * len(names))
    grid = figure.subplots(len(names), 1, squeeze=False, sharex=True)[:, 0]
    for axes, part in zip(grid, names):
        for name in part:
            times = sorted(run.first for run in rows[name] if run.solved)
            shares = 100 * np.arange(len(times) + 1) / len(rows[name])
            axes.plot(
                [start, *times, end],
                [*shares, shares[-1]],
                drawstyle="steps-post",
                color=looks[name].colour,
                linestyle=looks[name].line,
                label=shown(name),
            )
        axes.set(xscale="log", xlim=(start, end), ylim=(-2, 102), ylabel="runs with a path, %")
        axes.grid()
        side_legend(axes)
    plain_axis(grid[-1].xaxis, log=True)
    grid[-1].set_xlabel("time since the call, ms")
    return Picture(
        f"success-{slug(group)}",
        "Success against time",
        "Share of all runs that have found a path by a time, prediction included.",
        figure,
    )


def growth_pictures(results: PlanResults, looks: dict[str, Look]) -> list[Picture]:
    """Growth with the level and with the side of the map, where mazes of one kind have several."""
    pictures: list[Picture] = []
    by_level: dict[tuple[str, int], dict[int, list[str]]] = {}
    by_side: dict[tuple[str, int], dict[int, list[str]]] = {}
    for group in results.groups():
        maze = results.mazes.get(group)
        if maze is not None:
            by_level.setdefault((maze.kind, maze.pixels), {}).setdefault(maze.level, []).append(group)
            by_side.setdefault((maze.kind, maze.level), {}).setdefault(maze.pixels, []).append(group)
    for (_, side), groups in by_level.items():
        if len(groups) > 1:
            title = f"Growth with the level, maps of {side}×{side} pixels"
            name = f"growth-level-{len(pictures)}"
            pictures.append(_growth_picture(results, looks, groups, name, title, "level, blocks a side"))
    for (_, level), groups in by_side.items():
        if len(groups) > 1:
            title = f"Growth with the map, mazes of {level}×{level} blocks"
            name = f"growth-side-{len(pictures)}"
            pictures.append(_growth_picture(results, looks, groups, name, title, "side of the map, pixels"))
    return pictures


@styled
def _growth_picture(
    results: PlanResults, looks: dict[str, Look], groups: dict[int, list[str]], name: str, title: str, label: str
) -> Picture:
    sizes = sorted(groups)
    names = panels(results.planners())
    fields = [(f, title) for f, title in _GROWTH if any(value > 0 for value in values_of(results.runs, f))]
    figure = new_figure(2.1 + 2.7 * len(fields), 3.1 * len(names))
    grid = figure.subplots(len(names), len(fields), squeeze=False, sharex=True, sharey="col")
    for row, part in zip(grid, names):
        for axes, (field, quantity) in zip(row, fields):
            for planner in part:
                runs = [[r for group in groups[size] for r in results.rows(group).get(planner, [])] for size in sizes]
                _growth_line(axes, sizes, runs, field, shown(planner), looks[planner])
            axes.set(xscale="log", yscale="log", ylabel=quantity)
            axes.set_xticks(_thinned(sizes), [str(size) for size in _thinned(sizes)])
            axes.set_xticks([], minor=True)
            axes.set_xlim(sizes[0] / 1.05, sizes[-1] * 1.05)
            axes.grid()
        side_legend(row[-1])
    for axes in grid[-1]:
        _at_least_a_decade(axes)
        axes.set_xlabel(label)
    return Picture(
        name,
        title,
        "Medians over solved runs; both axes are logarithmic. Planners without a prediction have none.",
        figure,
    )


def _growth_line(axes: Axes, sizes: list[int], runs: list[list[Run]], field: Field, label: str, look: Look) -> None:
    medians = [quantile(values_of(row, field), 0.5) for row in runs]
    drawn = [median if median > 0 else math.nan for median in medians]
    axes.plot(sizes, drawn, color=look.colour, linestyle=look.line, marker=look.marker, markersize=4.5, label=label)


def _at_least_a_decade(axes: Axes) -> None:
    """A logarithmic axis that makes no mountains of noise."""
    low, high = axes.get_ylim()
    wider = math.sqrt(max(1.0, 10 / (high / low)))
    axes.set_ylim(low / wider, high * wider)
    plain_axis(axes.yaxis, log=True)


def _thinned(sizes: list[int]) -> list[int]:
    """At most eight of the sizes, for the marks of an axis."""
    step = -(-len(sizes) // 8)
    return sizes[::step]
