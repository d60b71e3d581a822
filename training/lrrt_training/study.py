# SPDX-License-Identifier: BSD-3-Clause
"""The paper's study: networks trained on a few maze levels, scored on all of them by what they mark themselves."""

from __future__ import annotations

import json
from itertools import cycle
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

import lrrt
from lrrt.report.style import COLOURS, MARKERS

from . import evaluate as scoring
from .export import export_onnx, metadata
from .families.external import ExternalMaps
from .scenes import SceneSource
from .store import MazeStore, write_text
from .train import CHECKPOINT, load_data, load_network

MARKS = ("<!-- study: written by the study command -->", "<!-- end of study -->")
KEPT, MODEL = "study.json", "study.onnx"  #: a run's scores and its exported network, in its folder
THRESHOLDS = [round(0.05 * k, 2) for k in range(4, 20)]
CALIBRATION_MAPS = 100  #: a level, of the evaluation split
_LABELS = {"accuracy": "accuracy", "redundancy": "redundancy", "connectivity": "connected"}

Result = dict[str, Any]  #: "trained" levels, "threshold", and "scores" by level


def scores_of(run: Path, store: MazeStore, levels: list[int], maps: int) -> Result:
    """Scores of a run's network on test mazes; those of an earlier call where nothing has changed since.

    The threshold is the one with the lowest metric on the evaluation split of the levels it was trained on.

    Raises:
        FileNotFoundError: the folder holds no run.
    """
    network, stage = load_network(run), load_data(run).curriculum.stages[-1]
    wanted = {"levels": levels, "maps": maps, "checkpoint": (run / CHECKPOINT).stat().st_mtime}
    kept = run / KEPT
    if kept.exists() and (found := json.loads(kept.read_text()))["wanted"] == wanted:
        return found["result"]
    model = run / MODEL
    export_onnx(network, model, stage.size, metadata(run.name, stage.size, network.classes, "", "", run.name))

    def groups(of: list[int], split: str) -> scoring.Groups:
        store.generate(of, (split,))
        made = SceneSource(store, ExternalMaps(run / "absent"), split).groups(of, stage.size, stage.pixel_share)
        return {str(level): made[str(level)] for level in of}

    rows = scoring.metric_by_threshold(
        lrrt.OnnxPredictor(model), groups(stage.levels, "evaluation"), CALIBRATION_MAPS, THRESHOLDS
    )
    threshold = scoring.best_threshold(THRESHOLDS, rows)
    scoring.write_threshold(model, threshold)
    scores = scoring.evaluate(lrrt.OnnxPredictor(model), groups(levels, "test"), maps, raw=True)
    result: Result = {"trained": stage.levels, "threshold": threshold, "scores": scores}
    write_text(kept, json.dumps({"wanted": wanted, "result": result}))
    return result


def table(results: dict[str, Result]) -> str:
    """Accuracy / redundancy / share of connected regions by level, in Markdown."""
    levels = list(next(iter(results.values()))["scores"])
    lines = [
        "| blocks | " + " | ".join(name.replace("_", " ") for name in results) + " |",
        "|---:" * (1 + len(results)) + "|",
    ]
    for level in levels:
        rows = (result["scores"][level] for result in results.values())
        cells = (f"{r['accuracy']:.3f} / {r['redundancy']:.3f} / {100 * r['connectivity']:.1f} %" for r in rows)
        lines.append(f"| {level} | " + " | ".join(cells) + " |")
    thresholds = ", ".join(f"{result['threshold']:g}" for result in results.values())
    return "\n".join([*lines, "", f"Thresholds, chosen on the evaluation split of the trained levels: {thresholds}."])


def figure(results: dict[str, Result], path: Path) -> None:
    """Accuracy, redundancy and connectivity against the level, a line for each network."""
    drawing = Figure(figsize=(11, 3.6), layout="constrained")
    for ax, (key, label) in zip(drawing.subplots(1, 3), _LABELS.items()):
        _panel(ax, results, key)
        ax.set_ylabel(label)
    handles, names = drawing.axes[0].get_legend_handles_labels()
    drawing.legend(handles, names, loc="outside upper center", ncols=len(names), frameon=False)
    drawing.savefig(path, dpi=110)


def _panel(ax: Axes, results: dict[str, Result], key: str) -> None:
    for (name, result), (colour, marker) in zip(results.items(), cycle(zip(COLOURS, cycle(MARKERS)))):
        scores = {int(level): row[key] for level, row in result["scores"].items() if level.isdecimal()}
        ax.plot(
            list(scores), list(scores.values()), color=colour, marker=marker, markersize=4, label=name.replace("_", " ")
        )
    trained = next(iter(results.values()))["trained"]
    ax.axvspan(min(trained) - 1, max(trained) + 1, color="0.92", zorder=0)
    ax.text(sum(trained) / len(trained), 0.02, "trained", ha="center", color="0.45", transform=ax.get_xaxis_transform())
    ax.set_xlabel("blocks a side")
    ax.set_ylim(0, None if key == "redundancy" else 1)
    ax.spines[["top", "right"]].set_visible(False)


def write(page: Path, results: dict[str, Result]) -> None:
    """The table into the page, the figure and the numbers beside it.

    Raises:
        ValueError: the page lacks the marks around the table.
    """
    figure(results, page.with_suffix(".png"))
    write_text(page.with_suffix(".json"), json.dumps(results, indent=1) + "\n")
    scoring.write_between_marks(page, table(results), MARKS)
