# SPDX-License-Identifier: BSD-3-Clause
"""What a campaign prints: times with Python's callbacks and without."""

from __future__ import annotations

from collections import Counter
from typing import Any

from rich.box import SIMPLE_HEAD
from rich.table import Table

from lrrt.report.formatting import median_and_quartiles

Json = dict[str, Any]


def without_callbacks(row: Json) -> float:
    """Milliseconds from the call to the first path, without what was spent on callbacks; an estimate."""
    return max(0.0, row["first_ms"] - row["first_callback_ms"] - row["first_dispatch_ms"])


def group_tables(document: Json) -> list[Table]:
    """A table for every group of maps."""
    by_group: dict[str, dict[str, list[Json]]] = {}
    for row in document["rows"]:
        by_group.setdefault(row["group"], {}).setdefault(row["planner"], []).append(row)
    return [_table(group, planners) for group, planners in by_group.items()]


def notes(document: Json) -> list[str]:
    """How to read the tables, and what went wrong."""
    cost = document["callback_overhead_us"]
    lines = [
        "Median [quartiles] of solved runs. First path: from the call, map tables and OMPL's set-up included.",
        "Callbacks: the collision checks and stop questions that the wheel asks of Python until then. The time inside "
        f"them is measured; the way there and back is reckoned as {cost['motion']:.2f} µs for a motion, "
        f"{cost['state']:.2f} for a state, {cost['stop']:.2f} for a question.",
        f"Measuring itself lengthens every motion's check by {cost['timing']:.2f} µs, counted as callback.",
    ]
    failures = Counter((row["planner"], row["status"]) for row in document["rows"] if not row["solved"])
    lines += [f"{planner}: {count} × {status}" for (planner, status), count in failures.items()]
    return lines


def _table(group: str, planners: dict[str, list[Json]]) -> Table:
    numbers = ("first path, ms", "of it callbacks", "without them", "iterations", "length / optimum")
    table = Table("planner", "solved", *numbers, title=group, title_justify="left", box=SIMPLE_HEAD)
    for name, rows in planners.items():
        solved = [row for row in rows if row["solved"]]
        columns = (
            [row["first_ms"] for row in solved],
            [row["first_callback_ms"] + row["first_dispatch_ms"] for row in solved],
            [without_callbacks(row) for row in solved],
            [row["iterations"] for row in solved],
            [row["length"] / row["optimum"] for row in solved if row["optimum"]],
        )
        table.add_row(name.split(" (PyPI")[0], f"{len(solved)}/{len(rows)}", *map(median_and_quartiles, columns))
    return table
