# SPDX-License-Identifier: BSD-3-Clause
"""The report that ``lrrt_bench`` prints, from a result file."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import PurePosixPath

from lrrt.report.formatting import THIN_SPACE
from lrrt.report.results import Head, PlanResults, PredictResults, load
from lrrt.report.tables import (
    HARD_COLUMNS,
    Table,
    gains_tables,
    hard_table,
    means_table,
    medians_table,
    predict_table,
    within_table,
)

_MEDIANS = ("solved (95 %)", "first path, ms", "prediction", "search", "iterations", "nodes", "length")
_MEANS = ("first path, ms", "search", "iterations", "nodes", "motion checks", "length", "clearance")
_GAINS = ("pairs", "first path", "search", "iterations", "nodes", "length")
_SETTING = ("model", "map", "input", "threads", "spinning", "batch")
_PREDICTIONS = (*_SETTING, "encode", "infer", "region", "all", "per second")


def terminal_report(path: str | os.PathLike[str]) -> str:
    """What lrrt_bench prints when it has made such a file; a suite without a title gets the name of the file.

    Raises:
        ResultError: names the file, the field and what was expected.
    """
    results = load(path)
    body = _plan_text(results) if isinstance(results, PlanResults) else _predict_text(results)
    return _heading(results.head) + body


def _heading(head: Head) -> str:
    names = {"lrrt": "lrrt", "ompl": "OMPL", "onnxruntime": "ONNX Runtime", "libtorch": "libtorch"}
    versions = ", ".join(f"{name} {head.versions[key]}" for key, name in names.items() if key in head.versions)
    cores = f", {head.machine['cores']} cores" if "cores" in head.machine else ""
    return f"{head.title}\n{versions}; {head.machine.get('processor', 'unknown')}{cores}\n\n"


def _plan_text(results: PlanResults) -> str:
    text = "".join(_group_text(results, group) for group in results.groups())
    overall = hard_table(results, results.groups()) if len(results.groups()) > 1 else None
    if overall is not None:
        text += f"== all groups\n\n{_hard_text(overall)}\n"
    return text + "Times, lengths, iterations and nodes are of solved runs. --help says what the columns mean.\n"


def _group_text(results: PlanResults, group: str) -> str:
    within, hard = within_table(results, group), hard_table(results, [group])
    tables = [
        _aligned(("median [quartiles]", *_MEDIANS), medians_table(results, group).rows),
        _aligned(("mean ± deviation", *_MEANS), means_table(results, group).rows),
    ]
    if within is not None:
        tables.append(_aligned(("to the optimum, ms", *within.columns[1:]), within.rows))
    if hard is not None:
        tables.append(_hard_text(hard))
    for gains in gains_tables(results, group):
        tables.append(_aligned((gains.title.replace("Gain", "gain", 1), *_GAINS), gains.rows))
    return f"== {group}\n\n" + "\n".join(tables) + "\n"


def _hard_text(table: Table) -> str:
    return _aligned((table.title.lower(), *HARD_COLUMNS), table.rows)


def _predict_text(results: PredictResults) -> str:
    table: Table = predict_table(results)
    rows = [(PurePosixPath(row.model).name, *cells[1:]) for row, cells in zip(results.rows, table.rows)]
    note = (
        "Milliseconds a prediction: median (95 % are below); of a batch, infer and all are shares. Per second: "
        "predictions, calls one after the other, all stages. Input: sides of the network's pictures."
    )
    return f"{note}\n" + _aligned(_PREDICTIONS, rows)


def _aligned(header: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> str:
    """The first column to the left, the others to the right."""
    lines = [header, *(tuple(cell.replace(THIN_SPACE, " ") for cell in row) for row in rows)]
    widths = [max(len(line[i]) for line in lines) for i in range(len(header))]
    text = ""
    for first, *others in lines:
        cells = [first.ljust(widths[0]), *(cell.rjust(width) for cell, width in zip(others, widths[1:]))]
        text += "  ".join(cells).rstrip() + "\n"
    return text
