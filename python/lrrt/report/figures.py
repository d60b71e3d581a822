# SPDX-License-Identifier: BSD-3-Clause
"""Figures of bars and cells; those of lines are in ``curves``. Each is made only where the data have it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from lrrt.report.curves import cost_picture, growth_pictures, success_picture
from lrrt.report.formatting import short_number, slug
from lrrt.report.results import Field, PlanResults, PredictResults, Run, Setting, values_of
from lrrt.report.statistics import quantile, summarize
from lrrt.report.style import COLOURS, INK, Look, Picture, new_figure, plain_axis, shown, styled
from lrrt.report.tables import model_names

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_MEANS: tuple[tuple[Field, str], ...] = (
    ("iterations", "iterations"),
    ("nodes", "nodes of the tree"),
    ("first", "time to the first path, ms"),
)
_WIDE_RANGE = 15.0  # means that differ by more are drawn on a logarithmic axis
_STAGES = ("encode", "infer", "region")


def overview_pictures(results: PlanResults, looks: dict[str, Look]) -> list[Picture]:
    """The figures that show all groups at once; none where no run found a path."""
    if not any(run.solved for run in results.runs):
        return []
    return [means_picture(results, looks), *growth_pictures(results, looks)]


def group_pictures(results: PlanResults, group: str, looks: dict[str, Look]) -> list[Picture]:
    """The figures of one group."""
    pictures = [cost_picture(results, group, looks), success_picture(results, group, looks)]
    return [picture for picture in pictures if picture is not None] + heat_pictures(results, group)


@styled
def means_picture(results: PlanResults, looks: dict[str, Look]) -> Picture:
    """Bars of the mean with its standard deviation, as in the paper: a row a group, a column a quantity."""
    groups = results.groups()
    counts = [len(results.rows(group)) for group in groups]
    figure = new_figure(9.6, 0.55 + sum(0.5 + 0.225 * count for count in counts))
    ratios = [0.4 + 0.225 * count for count in counts]
    grid = figure.subplots(len(groups), len(_MEANS), sharex="col", squeeze=False, height_ratios=ratios)
    names = [_with_share(name, runs) for group in groups for name, runs in results.rows(group).items()]
    width = (9.1 - 0.08 * max(map(len, names))) / len(_MEANS)
    for j, (field, title) in enumerate(_MEANS):
        column = [values_of(runs, field) for group in groups for runs in results.rows(group).values()]
        left, right = _limits(column, width)
        grid[-1, j].set_xscale("log" if left else "linear")
        for i, group in enumerate(groups):
            _bars(grid[i, j], results.rows(group), field, looks, left)
        grid[-1, j].set_xlabel(f"{title} (logarithmic)" if left else title)
        grid[-1, j].set_xlim(left, right)
        grid[-1, j].tick_params(axis="x", labelsize=7.5)
        plain_axis(
            grid[-1, j].xaxis, log=left > 0, room=0.43 / width, high=max(map(_end, filter(None, column)), default=1.0)
        )
    for i, group in enumerate(groups):
        grid[i, 0].set_title(shown(group, 70), loc="left")
        rows = results.rows(group)
        grid[i, 0].set_yticks(range(len(rows)), [_with_share(name, runs) for name, runs in rows.items()])
    return Picture(
        "means",
        "Iterations, nodes and time",
        "Mean (the number) and standard deviation over solved runs. Where not all were solved, a share behind the "
        "name tells how many.",
        figure,
    )


def _limits(column: list[list[float]], width: float) -> tuple[float, float]:
    """Ends of an axis so many inches wide, with room for the words behind the bars; above 0 it is logarithmic."""
    ends, rooms = [], []
    for values in filter(None, column):
        ends.append(_end(values))
        rooms.append(1 - min(0.8, (0.066 * len(_mean(values)) + 0.1) / width))
    means = [mean for mean in (summarize(values).mean for values in column) if mean > 0]
    if not means:
        return 0.0, 1.0
    if max(means) / min(means) <= _WIDE_RANGE:
        return 0.0, max(end / room for end, room in zip(ends, rooms))
    left = min(means) / 3
    return left, left * max(max(1.0, end / left) ** (1 / room) for end, room in zip(ends, rooms))


def _mean(values: Sequence[float]) -> str:
    return short_number(summarize(values).mean)


def _end(values: Sequence[float]) -> float:
    """Mean and one deviation, where there is one."""
    s = summarize(values)
    return s.mean + (0.0 if math.isnan(s.deviation) else s.deviation)


def _bars(axes: Axes, rows: dict[str, list[Run]], field: Field, looks: dict[str, Look], left: float) -> None:
    for y, (name, runs) in enumerate(rows.items()):
        values = values_of(runs, field)
        mean, end = summarize(values).mean, _end(values)
        if mean > left:
            axes.barh(y, mean - left, left=left, height=0.68, color=looks[name].colour, alpha=0.75, label=shown(name))
            axes.plot([max(left, 2 * mean - end), end], [y, y], color=INK, linewidth=1.3, solid_capstyle="butt")
        words = _mean(values) if values else "none solved"
        at = (max(left, end) if values else left, y)
        axes.annotate(words, at, xytext=(4, 0), textcoords="offset points", va="center", fontsize=7.5)
    axes.set_ylim(len(rows) - 0.4, -0.6)
    axes.set_yticks([])
    axes.spines["left"].set_visible(left == 0.0)
    axes.grid(axis="x")


def _with_share(name: str, runs: list[Run]) -> str:
    solved = sum(run.solved for run in runs)
    return shown(name) if solved == len(runs) else f"{shown(name)}  {solved}/{len(runs)}"


@styled
def heat_pictures(results: PlanResults, group: str) -> list[Picture]:
    """A map of α and model for each planner of which the suite has several of both."""
    families: dict[tuple[str, str, float], list[Setting]] = {}
    rows = results.rows(group)
    for s in results.settings.values():
        if s.guided and s.name in rows:
            families.setdefault((s.planner, s.strategy, s.range), []).append(s)
    pictures = []
    for settings in families.values():
        alphas = sorted({s.alpha for s in settings})
        models = list(dict.fromkeys(s.model for s in settings))
        if len(alphas) > 1 and len(models) > 1:
            pictures.append(_heat_picture(group, rows, settings, alphas, models))
    return pictures


def _heat_picture(
    group: str, rows: dict[str, list[Run]], settings: list[Setting], alphas: list[float], models: list[str]
) -> Picture:
    from matplotlib.colors import LogNorm, Normalize

    times = np.full((len(alphas), len(models)), math.nan)
    words = np.full(times.shape, "-", dtype=object)
    for s in settings:
        place = alphas.index(s.alpha), models.index(s.model)
        runs = rows[s.name]
        times[place] = quantile(values_of(runs, "first"), 0.5)
        solved = sum(run.solved for run in runs)
        words[place] = short_number(times[place]) + ("" if solved == len(runs) else f"\n{solved}/{len(runs)}")
    known = times[np.isfinite(times)]
    low, high = (float(known.min()), float(known.max())) if len(known) else (0.0, 1.0)
    wide = low > 0 and high / low > 10
    norm = LogNorm(low, high) if wide else Normalize(low, high)
    figure = new_figure(2.6 + 0.85 * len(models), 1.5 + 0.42 * len(alphas))
    axes = figure.subplots()
    mesh = axes.pcolormesh(np.ma.masked_invalid(times), cmap="cividis", norm=norm, edgecolors="none")
    for (i, j), word in np.ndenumerate(words):
        dark = math.isfinite(times[i, j]) and float(norm(times[i, j])) < 0.55
        colour = INK if not math.isfinite(times[i, j]) else "#ffffff" if dark else "#000000"
        axes.text(j + 0.5, i + 0.5, word, ha="center", va="center", color=colour, fontsize=8.5)
    names = model_names(models)
    axes.set_xticks(np.arange(len(models)) + 0.5, [shown(names[model], 24) for model in models])
    if max(len(name) for name in names.values()) > 11:
        axes.tick_params(axis="x", labelrotation=30)
    axes.set_yticks(np.arange(len(alphas)) + 0.5, [f"{alpha:g}" for alpha in alphas])
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)
    axes.set(xlabel="model", ylabel="α, share of guided samples")
    bar = figure.colorbar(mesh, ax=axes, label="time to the first path, ms")
    bar.outline.set_visible(False)
    plain_axis(bar.ax.yaxis, log=wide)
    first = settings[0]
    what = f"{first.planner} with {first.strategy} samples"
    what += f", range {first.range:g}" if first.range else ""
    return Picture(
        f"alpha-{slug(group)}-{slug(first.planner)}-{slug(first.strategy)}",
        f"α and model: {what}",
        "Median time from the call to the first path, ms, over solved runs; where not all were solved, a share below "
        "it tells how many.",
        figure,
    )


@styled
def predict_pictures(results: PredictResults) -> list[Picture]:
    """Bars of the stages of a prediction, a panel for each size of the maps."""
    from matplotlib.patches import Patch

    names = model_names([row.model for row in results.rows])
    sizes = list(dict.fromkeys(row.size for row in results.rows))
    by_size = [[row for row in results.rows if row.size == size] for size in sizes]
    heights = [0.45 + 0.26 * len(rows) for rows in by_size]
    figure = new_figure(8.4, 0.9 + sum(heights) + 0.3 * len(sizes))
    grid = figure.subplots(len(sizes), 1, squeeze=False, height_ratios=heights)[:, 0]
    several = len(set(names.values())) > 1
    for axes, size, rows in zip(grid, sizes, by_size):
        ends = []
        for y, row in enumerate(rows):
            end = 0.0
            for stage, colour in zip(range(len(_STAGES)), COLOURS):
                time = quantile(row.times[:, stage], 0.5)
                axes.barh(y, time, left=end, height=0.68, color=colour)
                end += time
            ends.append(end)
            text = short_number(end)
            axes.annotate(text, (end, y), xytext=(4, 0), textcoords="offset points", va="center", fontsize=8)
        axes.set_title(f"maps of {size}×{size} pixels", loc="left")
        labels = []
        for row in rows:
            threads = (
                f"{row.threads} thread" + ("s" if row.threads > 1 else "") + (", spinning" if row.spinning else "")
            )
            batch = f", batches of {row.batch}" if row.batch > 1 else ""
            labels.append((f"{shown(names[row.model])}, " if several else "") + threads + batch)
        axes.set_yticks(range(len(rows)), labels)
        axes.tick_params(axis="y", length=0)
        axes.set_ylim(len(rows) - 0.4, -0.6)
        axes.set_xlim(0, 1.12 * max(1e-6, *ends))
        plain_axis(axes.xaxis)
        axes.grid(axis="x")
    grid[-1].set_xlabel("time of one prediction, ms")
    handles = [Patch(color=colour, label=stage) for stage, colour in zip(_STAGES, COLOURS)]
    grid[0].legend(handles=handles, loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=3, borderaxespad=0.2)
    return [
        Picture(
            "prediction",
            "Stages of a prediction" if several else f"Stages of a prediction: {next(iter(names.values()))}",
            "Medians of encoding the map, the network's inference and bringing the region back; the number is their "
            "sum. Every size of map has a scale of its own.",
            figure,
        )
    ]
