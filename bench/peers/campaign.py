# SPDX-License-Identifier: BSD-3-Clause
"""Every planner on every query: what a campaign is made of, and the processes that it runs one after the other."""

from __future__ import annotations

import datetime
import importlib.metadata
import json
import os
import platform
import subprocess
import sys
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from lrrt.report.fields import ResultError
from peers.planners import PEERS
from peers.problems import RANGE_PIXELS, STOPS, Problems, Setting
from peers.results import ResultFile
from peers.rows import Json, Task, row_of

_BENCH = Path(__file__).resolve().parents[1]  # where the package peers is found
_GRACE = 30.0  # seconds beside the searches: to start, to read the map, to tell the answer


@dataclass(frozen=True)
class Wishes:
    """What the command line asks for; None leaves it to the suite."""

    planners: tuple[str, ...] = tuple(PEERS)
    runs: int | None = None
    seed: int | None = None
    time_limit: float | None = None
    stop: str | None = None


def wheel_version() -> str:
    """The version of the wheel.

    Raises:
        ResultError: it is not installed, or too old: its bindings were others before 2.0.
    """
    advice = "expected the PyPI package ompl, 2.0 or newer: pip install 'ompl>=2.0,<3', or lrrt's extra 'peers'"
    try:
        version = importlib.metadata.version("ompl")
    except importlib.metadata.PackageNotFoundError as error:
        raise ResultError(f"ompl is not installed; {advice}") from error
    if int(version.split(".")[0]) < 2:
        raise ResultError(f"ompl {version} is installed; {advice}")
    return version


def setting_of(kind: str, problems: Problems, wishes: Wishes) -> Setting:
    """How a planner is set: by the suite, but for what the command line says.

    Raises:
        ResultError: the suite stops near the optimum, which is lrrt's own.
    """
    setting = problems.setting(kind)
    stop = wishes.stop or setting.stop
    if stop not in STOPS:
        raise ResultError(f"{problems.folder}: its suite stops by '{stop}'; expected --stop first or --stop limit")
    return replace(setting, stop=stop, time_limit=wishes.time_limit or setting.time_limit)


def tasks_of(problems: Problems, wishes: Wishes, version: str) -> list[Task]:
    """All rows, in the order of lrrt_bench: planners innermost, so that all of them meet the same disturbances."""
    seed = problems.seed if wishes.seed is None else wishes.seed
    settings = {kind: setting_of(kind, problems, wishes) for kind in wishes.planners}
    return [
        Task(problem, kind, row_name(kind, version), setting, seed + run)
        for problem in problems.problems
        for run in range(wishes.runs or problems.runs)
        for kind, setting in settings.items()
    ]


def row_name(kind: str, version: str) -> str:
    """As in ``RRT* (PyPI ompl 2.0.1)``."""
    return f"{PEERS[kind].name} (PyPI ompl {version})"


def header_of(problems: Problems, wishes: Wishes, version: str) -> Json:
    """What all rows share, as lrrt_bench says it."""
    planners = [_planner_json(kind, problems, wishes, version) for kind in wishes.planners]
    title = problems.suite.get("title") or problems.folder.name
    suite = {
        **problems.suite,
        "title": f"{title} · planners of the PyPI wheel",
        "baseline": planners[0]["name"],
        "runs": wishes.runs or problems.runs,
        "seed": problems.seed if wishes.seed is None else wishes.seed,
        "planners": planners,
    }
    return {
        "suite": suite,
        "inputs": {"pictures": problems.checksums()},
        "versions": {"ompl": f"{version} (PyPI wheel)", "python": platform.python_version()},
        "machine": {"processor": _processor(), "cores": os.cpu_count(), "system": _system()},
        "started": f"{datetime.datetime.now(datetime.timezone.utc):%Y-%m-%d %H:%M:%S}",
    }


def run_tasks(tasks: Sequence[Task], results: ResultFile, done: Callable[[Task], object]) -> None:
    """Makes the rows that are missing, one after the other; ``done`` is told of each."""
    for task in tasks:
        if task.id not in results:
            answer = answer_of(task.job(), _GRACE + 2 * task.setting.time_limit)
            results.add(row_of(task, answer, results.header["callback_overhead_us"]))
        done(task)


def answer_of(job: Json, patience: float) -> Json:
    """What the search process says to a job; ``crashed`` where it says nothing, or nothing in so many seconds."""
    try:
        run = _process("peers.search", json.dumps(job), patience)
        return _last_object(run.stdout) if run.returncode == 0 else _crashed(run)
    except subprocess.TimeoutExpired:
        return {"status": "crashed", "error": f"no answer after {patience:g} s"}


def measured_overheads() -> dict[str, float]:
    """See ``peers.callbacks.overheads``.

    Raises:
        ResultError: the wheel does not run.
    """
    run = _process("peers.callbacks", "", _GRACE)
    if run.returncode != 0:
        raise ResultError(f"the wheel ompl does not run: {_crashed(run)['error']}; expected one for this Python")
    return _last_object(run.stdout)


def _process(module: str, text: str, patience: float) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", module]
    return subprocess.run(
        command, input=text, cwd=_BENCH, timeout=patience, capture_output=True, text=True, check=False
    )


def _last_object(output: str) -> dict[str, Any]:
    return dict(json.loads(output.splitlines()[-1]))


def _crashed(run: subprocess.CompletedProcess[str]) -> Json:
    lines = [line for line in run.stderr.splitlines() if line.strip()]
    return {"status": "crashed", "error": f"exit code {run.returncode}: {lines[-1] if lines else 'no message'}"}


def _planner_json(kind: str, problems: Problems, wishes: Wishes, version: str) -> Json:
    setting = setting_of(kind, problems, wishes)
    # Where the suite leaves the range to lrrt it is told in the unit of the first map; all maps get as many pixels.
    span = {} if setting.range else {"range": RANGE_PIXELS * problems.problems[0].resolution, "pixels": RANGE_PIXELS}
    return {
        "name": row_name(kind, version),
        "planner": kind,
        "strategy": "uniform",
        "alpha": 0.0,
        "model": "",
        **asdict(setting),
        **span,
        "cost_factor": 1.0,
        "iteration_limit": 0,
    }


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return "unknown"
    return next((line.split(": ", 1)[1] for line in lines if line.startswith("model name") and ": " in line), "unknown")


def _system() -> str:
    names = platform.uname()
    return f"{names.system} {names.release} {names.machine}"
