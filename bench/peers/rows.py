# SPDX-License-Identifier: BSD-3-Clause
"""Answers of the search process as rows of a result, with the fields and units of ``lrrt_bench --json``."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from lrrt.report.results import WITHIN_PERCENTS
from peers.problems import RANGE_PIXELS, Problem, Setting

Json = dict[str, Any]

#: For a search that gave no answer.
_NOTHING = {"prepare_ms": 0.0, "plan_ms": 0.0, "spent": [0.0, 0, 0, 0], "nodes": 0, "history": []}


@dataclass(frozen=True)
class Task:
    """One row to be made."""

    problem: Problem
    planner: str  #: one of PEERS
    name: str  #: of the planner, as the row says it
    setting: Setting
    seed: int

    @property
    def id(self) -> str:
        """Tells the row from all others, as in lrrt_bench."""
        return f"{self.problem.map} | {self.problem.query} | {self.name} | {self.seed}"

    def job(self) -> Json:
        """What the search process is told; lengths are pixels there."""
        unit = self.problem.resolution
        return {
            "picture": str(self.problem.picture.resolve()),
            "start": self.problem.start,
            "goal": self.problem.goal,
            "planner": self.planner,
            "seed": self.seed,
            **asdict(self.setting),
            "range": self.setting.range / unit or RANGE_PIXELS,
            "goal_tolerance": self.setting.goal_tolerance / unit,
        }


def row_of(task: Task, answer: Json, overheads: dict[str, float]) -> Json:
    """The row of a search that answered.

    Args:
        task: what was asked.
        answer: what ``peers.search`` printed.
        overheads: microseconds a callback that its own clock does not see, as ``peers.callbacks`` measured them.
    """
    answer = {**_NOTHING, **answer}
    times = {"prepare": answer["prepare_ms"], "encode": 0.0, "infer": 0.0, "region": 0.0, "plan": answer["plan_ms"]}
    solved = answer["status"] == "solved"
    row = {
        "id": task.id,
        "group": task.problem.group,
        "map": task.problem.map,
        "query": task.problem.query,
        "planner": task.name,
        "seed": task.seed,
        "status": answer["status"],
        "solved": solved,
        "iterations": answer["spent"][3],
        "nodes": answer["nodes"],
        "motion_checks": answer["spent"][1],
        "ended_by_clock": answer["plan_ms"] >= 1e3 * task.setting.time_limit,
        "times_ms": {**times, "total": answer["prepare_ms"] + answer["plan_ms"]},
        **_callbacks(answer["spent"], overheads),
    }
    row |= {key: answer[key] for key in ("violations", "error") if key in answer}
    return row | _path(task, answer, overheads) if solved else row


def _callbacks(spent: list[float], overheads: dict[str, float], prefix: str = "") -> Json:
    """Calls, milliseconds inside them, and milliseconds on the way to them and back."""
    inside, *counts = spent
    around = sum(count * overheads[kind] for count, kind in zip(counts, ("motion", "state", "stop"))) / 1e3
    return {f"{prefix}callbacks": sum(counts), f"{prefix}callback_ms": inside, f"{prefix}dispatch_ms": around}


def _path(task: Task, answer: Json, overheads: dict[str, float]) -> Json:
    unit, optimum = task.problem.resolution, task.problem.optimum
    history = [[time, iteration, length * unit] for time, iteration, length, *_ in answer["history"]]
    before = answer["prepare_ms"]
    within = {}
    for percent in WITHIN_PERCENTS:
        target = (optimum or 0.0) * (1 + percent / 100)
        within[str(percent)] = next((before + time for time, _, length in history if length <= target), None)
    return {
        "first_ms": before + history[0][0],
        "search_ms": history[0][0],
        **_callbacks(answer["history"][0][3:], overheads, "first_"),
        "first_iteration": history[0][1],
        "first_length": history[0][2],
        "length": answer["length"] * unit,
        "optimum": optimum,
        "within_ms": within,
        "history": history,
    }
