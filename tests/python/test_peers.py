# SPDX-License-Identifier: BSD-3-Clause
"""``bench/peers``: its collision check against exact arithmetic and the library, its files, and the wheel's planners.

What runs the wheel is skipped where the extra ``peers`` is not installed.
"""

from __future__ import annotations

import copy
import importlib.metadata
import json
import math
import subprocess
import sys
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from oracle import first_collision
from peers import campaign, tables
from peers.planners import PEERS
from peers.problems import Problem, Setting, read_problems
from peers.results import ResultFile
from peers.rows import Task, row_of
from peers.run import app
from peers.validity import PictureError, SegmentCheck, read_free
from PIL import Image
from typer.testing import CliRunner

import lrrt
from lrrt.report import PlanResults, ResultError, load, write_report

BENCH = Path(__file__).resolve().parents[2] / "bench"

try:
    WHEEL = campaign.wheel_version()
except ResultError as error:
    WHEEL, REASON = "", f"{error}"
else:
    REASON = ""
with_the_wheel = pytest.mark.skipif(not WHEEL, reason=REASON)

OVERHEADS = {"motion": 0.5, "state": 0.25, "stop": 0.125, "timing": 0.25}


def random_free(rng: np.random.Generator, height: int, width: int, share: float) -> np.ndarray:
    return rng.random((height, width)) >= share


# The exact check


def touched(a: tuple[Fraction, Fraction], b: tuple[Fraction, Fraction]) -> set[tuple[int, int]]:
    """The pixels (column, row) that a segment touches, in exact arithmetic, from the contract alone."""
    (x0, y0), (x1, y1) = a, b
    instants = {Fraction(0), Fraction(1)}
    for start, end in ((x0, x1), (y0, y1)):
        lines = range(math.ceil(min(start, end)), math.floor(max(start, end)) + 1) if start != end else ()
        instants |= {(line - start) / (end - start) for line in lines}
    crossings = sorted(instants)
    ordered = sorted([*crossings, *((s + t) / 2 for s, t in zip(crossings, crossings[1:]))])
    points = [(x0 + t * (x1 - x0), y0 + t * (y1 - y0)) for t in ordered]
    pixels = [(math.floor(x), math.floor(y)) for x, y in points]
    around = set(pixels)
    for x, y in points[1:-1]:
        if x.denominator == y.denominator == 1 and x0 != x1 and y0 != y1:  # through a corner
            around |= {(int(x) - i, int(y) - j) for i in (0, 1) for j in (0, 1)}
    for (c, r), (next_c, next_r) in zip(pixels, pixels[1:]):
        if c != next_c and r != next_r:  # from pixel to pixel through a corner, at an end too
            around |= {(c, next_r), (next_c, r)}
    return around


@pytest.mark.parametrize(
    ("side", "step", "share", "maps"), [(6, 2, 0.15, 20), (12, 4, 0.1, 20), (60, 4, 0.01, 5), (300, 8, 0.002, 1)]
)
def test_segments_are_judged_as_exact_arithmetic_judges_them(side, step, share, maps):
    """On a lattice, where corners, borders and ends on borders are as common as anything else."""
    rng = np.random.default_rng(side)
    verdicts = []
    for _ in range(maps):
        free = random_free(rng, side, side + 3, share)
        check = SegmentCheck(free)
        for _ in range(100):
            numbers = rng.integers(0, [side * step + 3 * step, side * step] * 2)
            x0, y0, x1, y1 = (Fraction(int(number), step) for number in numbers)
            expected = all(free[row, column] for column, row in touched((x0, y0), (x1, y1)))
            verdicts.append(expected)
            assert check.is_free(*map(float, (x0, y0, x1, y1))) == expected, (x0, y0, x1, y1)
            assert check.is_free(*map(float, (x1, y1, x0, y0))) == expected, (x1, y1, x0, y0)
    assert 0.1 < np.mean(verdicts) < 0.9


def test_segments_are_judged_as_the_library_judges_them():
    """RRT that only aims at the goal, as far as it likes: one iteration is one check of the library."""
    rng = np.random.default_rng(2)
    verdicts = []
    for _ in range(10):
        free = random_free(rng, 20, 30, 0.05)
        check, map_ = SegmentCheck(free), lrrt.OccupancyMap.from_array(~free)
        for lattice in (None, 2, 3, 7):  # thirds and sevenths meet corners only but for rounding
            ends = rng.uniform((0, 0), (30, 20), (40, 2, 2))
            ends = ends if lattice is None else np.floor(ends * lattice) / lattice
            for a, b in ends:
                if np.array_equal(a, b) or not (check.is_free_point(*a) and check.is_free_point(*b)):
                    continue
                aims = {"planner": "RRT", "strategy": "uniform", "goal_bias": 1.0, "range": 1e3, "iteration_limit": 1}
                verdicts.append(check.is_free(*a, *b))
                assert lrrt.plan(map_, a, b, **aims).solved == verdicts[-1], (a, b)
    assert 0.2 < np.mean(verdicts) < 0.8


def test_segments_never_touch_what_lies_beyond_their_ends():
    free = np.ones((4, 6), dtype=bool)
    free[1, 3] = False
    assert SegmentCheck(free).is_free(1.0, 0.5, 3.0 - 1e-12, 2.0)
    assert not SegmentCheck(free).is_free(1.0, 0.5, 3.0 + 1e-12, 2.0)


def test_points_outside_the_map_are_not_free():
    check = SegmentCheck(np.ones((4, 6), dtype=bool))
    assert check.is_free(0.0, 0.0, 5.999, 3.999) and check.is_free_point(0.0, 0.0)
    for x, y in ((-1e-9, 1.0), (6.0, 1.0), (1.0, -0.5), (1.0, 4.0), (math.nan, 1.0), (1.0, math.inf)):
        assert not check.is_inside(x, y) and not check.is_free_point(x, y)
        assert not check.is_free(x, y, 1.0, 1.0) and not check.is_free(1.0, 1.0, x, y)


# Problems


def problems_folder(folder: Path, free: np.ndarray | None = None, **changes: Any) -> Path:
    """What lrrt_bench --problems writes: one map with a wall and a door, one query, metres."""
    if free is None:
        free = np.ones((24, 32), dtype=bool)
        free[:18, 15] = False
    Image.fromarray(np.where(free, 255, 0).astype(np.uint8)).save(folder / "map_1.png")
    row = {"alpha": 0.8, "model": "default", "goal_bias": 0.05, "goal_tolerance": 0.0, "stop": "first"}
    row |= {"time_limit": 5.0, "cost_factor": 1.05, "iteration_limit": 0}
    planners = [
        {"name": "guided", "planner": "RRTstar", "strategy": "frontier", "range": 0.0, **row},
        {"name": "RRT*", "planner": "RRTstar", "strategy": "uniform", "range": 2.0, **row},
    ]
    suite = {"title": "A wall", "kind": "plan", "baseline": "guided", "runs": 2, "seed": 7, "planners": planners}
    suite["maps"] = [{"kind": "file", "name": "wall", "path": "wall.png"}]
    problem = {"group": "walls", "map": "wall", "query": "points", "picture": "map_1.png", "resolution": 0.5}
    problem |= {"start_pixel": [4.5, 4.5], "goal_pixel": [27.5, 4.5], "optimum": 18.0}
    document = {"suite": suite, "problems": [problem]}
    for path, value in changes.items():
        place: Any = document
        *keys, last = (int(key) if key.isdigit() else key for key in path.split("__"))
        for key in keys:
            place = place[key]
        place[last] = value
    (folder / "problems.json").write_text(json.dumps(document), encoding="utf-8")
    return folder


def test_problems_are_read(tmp_path):
    problems = read_problems(problems_folder(tmp_path))
    (problem,) = problems.problems
    assert (problem.start, problem.goal, problem.optimum) == ((4.5, 4.5), (27.5, 4.5), 18.0)
    assert (problems.runs, problems.seed) == (2, 7)
    assert problems.setting("RRTstar").range == 2.0  # of the row without guidance
    assert problems.setting("AORRTC").range == 0.0  # of the baseline
    assert read_problems(problems_folder(tmp_path, problems__0__optimum=None)).problems[0].optimum is None


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"suite__baseline": "nobody"}, ["'suite.baseline'", "one of the planners"]),
        ({"suite__runs": 0}, ["'suite.runs' is 0", "at least 1"]),
        ({"suite__seed": "one"}, ["'suite.seed'", "a whole number"]),
        ({"suite__planners": []}, ["'suite.planners'", "a list of planners"]),
        ({"suite__planners__0__stop": "never"}, ["'suite.planners[0].stop'", "'first'"]),
        ({"suite__planners__1__time_limit": 0}, ["'suite.planners[1].time_limit' is 0", "above 0"]),
        ({"problems": []}, ["'problems' is []", "a list of queries"]),
        ({"problems__0__start_pixel": [1]}, ["'problems[0].start_pixel' is [1]", "[x, y] in pixels"]),
        ({"problems__0__goal_pixel": None}, ["'problems[0].goal_pixel'", "[x, y] in pixels"]),
        ({"problems__0__resolution": -1.0}, ["'problems[0].resolution'", "above 0"]),
        ({"problems__0__headings": [0.0, 1.0]}, ["'problems[0].headings'", "points through the plane"]),
        ({"problems__0__picture": "gone.png"}, ["gone.png", "cannot be read", "lrrt_bench --problems"]),
        ({"problems__0__picture": "problems.json"}, ["problems.json", "cannot be read"]),
    ],
)
def test_broken_problems_exit_with_2_and_name_file_and_field(tmp_path, changes, words):
    problems_folder(tmp_path, **changes)
    run = CliRunner().invoke(app, [str(tmp_path), "--json", str(tmp_path / "out.json")])
    assert run.exit_code == 2 and run.stderr.startswith("error:") and "Traceback" not in run.stderr
    assert all(word in run.stderr for word in [str(tmp_path), *words]), run.stderr
    assert not list(tmp_path.glob("out*"))


def test_folders_without_problems_are_refused(tmp_path):
    with pytest.raises(ResultError, match=r"problems\.json: cannot be read.*lrrt_bench --problems"):
        read_problems(tmp_path)


def test_pictures_with_other_colours_are_refused(tmp_path):
    Image.fromarray(np.full((3, 3), 128, np.uint8)).save(tmp_path / "grey.png")
    with pytest.raises(PictureError, match=r"grey\.png: has grey 128; expected .* white is free"):
        read_free(tmp_path / "grey.png")


# Rows and files


def task(seed: int = 1, **setting: Any) -> Task:
    problem = Problem("walls", "wall", "points", Path("map_1.png"), 0.5, (4.5, 4.5), (27.5, 4.5), 18.0)
    settings = {"range": 2.0, "goal_bias": 0.05, "goal_tolerance": 0.25, "stop": "first", "time_limit": 5.0} | setting
    return Task(problem, "RRTstar", "RRT* (PyPI ompl 2.0.1)", Setting(**settings), seed)


def solved(scale: float = 1.0) -> dict[str, Any]:
    """An answer with two paths; lengths are pixels of half a metre."""
    history = [[8.0 * scale, 30, 40.0, 4.0, 60, 4, 30], [20.0 * scale, 90, 37.0, 10.0, 200, 4, 90]]
    spent = [12.0, 250, 4, 120]
    answer = {"status": "solved", "prepare_ms": 1.0, "plan_ms": 25.0, "spent": spent, "nodes": 50, "length": 37.0}
    return {**answer, "violations": 0, "history": history, "path": [[4.5, 4.5], [27.5, 4.5]]}


def header(**changes: Any) -> dict[str, Any]:
    planner = {"name": task().name, "planner": "RRTstar", "strategy": "uniform", "alpha": 0.0, "model": ""}
    planner |= {"range": 2.0, "stop": "first", "time_limit": 5.0}
    suite = {"title": "A wall", "kind": "plan", "baseline": task().name, "planners": [planner]}
    suite["maps"] = [{"kind": "file", "name": "wall", "path": "wall.png"}]
    versions = {"ompl": "2.0.1 (PyPI wheel)"}
    moment = {"started": "2026-11-22 14:00:00", "callback_overhead_us": OVERHEADS, "command": "python run.py"}
    return copy.deepcopy({"suite": suite, "versions": versions, "machine": {"cores": 2}, **moment} | changes)


def test_jobs_are_told_in_pixels():
    job = task().job()
    assert (job["range"], job["goal_tolerance"], job["start"]) == (4.0, 0.5, (4.5, 4.5))
    assert task(range=0.0).job()["range"] == 6.0


def test_rows_have_the_units_and_fields_of_lrrt_bench():
    row = row_of(task(), solved(), OVERHEADS)
    assert row["id"] == "wall | points | RRT* (PyPI ompl 2.0.1) | 1"
    assert (row["first_ms"], row["search_ms"], row["first_length"], row["length"]) == (9.0, 8.0, 20.0, 18.5)
    assert row["history"] == [[8.0, 30, 20.0], [20.0, 90, 18.5]]
    assert row["within_ms"] == {"10": 21.0, "5": 21.0, "2": None, "1": None}
    assert (row["iterations"], row["nodes"], row["times_ms"]["total"]) == (120, 50, 26.0)
    assert row["motion_checks"] == 250


def test_callbacks_are_told_apart():
    row = row_of(task(), solved(), OVERHEADS)
    assert (row["callbacks"], row["callback_ms"]) == (374, 12.0)
    assert row["dispatch_ms"] == pytest.approx((250 * 0.5 + 4 * 0.25 + 120 * 0.125) / 1e3)
    assert (row["first_callbacks"], row["first_callback_ms"]) == (94, 4.0)
    assert tables.without_callbacks(row) == pytest.approx(9.0 - 4.0 - (60 * 0.5 + 4 * 0.25 + 30 * 0.125) / 1e3)


def test_the_report_accepts_what_is_written(tmp_path):
    tasks = [task(seed) for seed in (1, 2, 3, 4, 5)]
    answers = [solved(), {"status": "crashed", "error": "exit code -11: no message"}, solved(2.0)]
    answers += [{**solved(), "status": "wrong_path", "violations": 1}, solved(3.0)]
    file = ResultFile(tmp_path / "peers.json", header())
    for each, answer in zip(tasks, answers):
        file.add(row_of(each, answer, OVERHEADS))
    document = file.finish([each.id for each in tasks])
    results = load(tmp_path / "peers.json")
    assert isinstance(results, PlanResults) and not (tmp_path / "peers.json.part").exists()
    assert [run.solved for run in results.runs] == [True, False, True, False, True]
    assert [run.first for run in results.runs if run.solved] == [9.0, 17.0, 25.0]
    assert results.runs[0].length == pytest.approx(18.5 / 18.0)
    write_report([tmp_path / "peers.json"], tmp_path / "out.html")
    text = (tmp_path / "out.html").read_text(encoding="utf-8")
    assert "python run.py" in text and "--replay" not in text and "2.0.1 (PyPI wheel)" in text
    assert any("1 × crashed" in line for line in tables.notes(document)) and tables.group_tables(document)


def test_an_interrupted_run_goes_on(tmp_path):
    file = ResultFile(tmp_path / "f", header())
    file.add(row_of(task(1), solved(), OVERHEADS))
    with (tmp_path / "f.part").open("a") as part:
        part.write('{"id":"half a li')
    again = ResultFile(tmp_path / "f", header(started="later", callback_overhead_us={}))
    assert len(again) == 1 and task(1).id in again and task(2).id not in again
    assert again.header["started"] == "2026-11-22 14:00:00"
    again.add(row_of(task(2), solved(), OVERHEADS))
    assert [row["seed"] for row in again.finish([task(1).id, task(2).id])["rows"]] == [1, 2]


def test_a_run_that_was_begun_with_something_else_is_refused(tmp_path):
    ResultFile(tmp_path / "f", header())
    with pytest.raises(ResultError, match=r"f\.part: was begun with other problems.*remove the file"):
        ResultFile(tmp_path / "f", header(versions={"ompl": "2.0.0 (PyPI wheel)"}))
    with pytest.raises(ResultError, match="cannot be written"):
        ResultFile(tmp_path / "no folder" / "f", header())


# The campaign


def test_rows_are_as_many_as_asked_for_and_settings_are_the_suites(tmp_path):
    problems = read_problems(problems_folder(tmp_path))
    tasks = campaign.tasks_of(problems, campaign.Wishes(), "2.0.1")
    assert len(tasks) == 2 * len(PEERS) == len({each.id for each in tasks})
    assert [each.seed for each in tasks] == [7] * len(PEERS) + [8] * len(PEERS)
    wishes = campaign.Wishes(("BITstar",), runs=1, seed=0, time_limit=0.5, stop="limit")
    (only,) = campaign.tasks_of(problems, wishes, "2.0.1")
    assert (only.name, only.seed) == ("BIT* (PyPI ompl 2.0.1)", 0)
    assert (only.setting.time_limit, only.setting.stop) == (0.5, "limit")


def test_suites_that_stop_near_the_optimum_need_another_stop(tmp_path):
    problems = read_problems(problems_folder(tmp_path, suite__planners__0__stop="factor"))
    with pytest.raises(ResultError, match=r"stops by 'factor'; expected --stop first"):
        campaign.tasks_of(problems, campaign.Wishes(), "2.0.1")


def test_a_crash_and_a_hang_are_rows(tmp_path):
    crashed = campaign.answer_of({"no": "job"}, 60.0)
    assert crashed["status"] == "crashed" and "exit code 1" in crashed["error"]
    hung = campaign.answer_of(task().job(), 1e-3)
    assert hung["status"] == "crashed" and "no answer" in hung["error"]
    row = row_of(task(), crashed, OVERHEADS)
    assert (row["status"], row["solved"], row["iterations"], row["error"]) == ("crashed", False, 0, crashed["error"])


def test_a_missing_or_old_wheel_is_told(tmp_path, monkeypatch):
    def missing(name: str) -> str:
        raise importlib.metadata.PackageNotFoundError(name)

    for version in (missing, lambda name: "1.7.0"):
        monkeypatch.setattr(importlib.metadata, "version", version)
        run = CliRunner().invoke(app, [str(problems_folder(tmp_path)), "--json", str(tmp_path / "out.json")])
        assert run.exit_code == 2 and "pip install" in run.stderr and "'peers'" in run.stderr


# The wheel


def answer(folder: Path, planner: str, before: str = "", **changes: Any) -> dict[str, Any]:
    """What the search process answers; ``before`` is code that it runs first."""
    (each,) = campaign.tasks_of(read_problems(folder), campaign.Wishes((planner,), runs=1), WHEEL)
    code = f"{before}\nfrom peers.search import main\nmain()"
    job = json.dumps({**each.job(), **changes})
    run = subprocess.run([sys.executable, "-c", code], input=job, cwd=BENCH, capture_output=True, text=True, check=True)
    return json.loads(run.stdout.splitlines()[-1])


@with_the_wheel
@pytest.mark.parametrize("planner", PEERS)
@pytest.mark.parametrize("stop", ["first", "limit"])
def test_planners_of_the_wheel_find_free_paths(tmp_path, planner, stop):
    folder = problems_folder(tmp_path)
    found = answer(folder, planner, stop=stop, time_limit=0.5)
    assert found["status"] == "solved" and found["violations"] == 0 and found["spent"][1] > 0
    path = np.array(found["path"])
    assert first_collision(read_free(folder / "map_1.png"), path) is None
    assert path[0] == pytest.approx((4.5, 4.5)) and path[-1] == pytest.approx((27.5, 4.5))
    assert found["length"] >= math.hypot(10.5, 13.5) + 1.0 + math.hypot(11.5, 13.5)  # round the wall's two corners
    costs = [cost for _, _, cost, *_ in found["history"]]
    assert costs == sorted(costs, reverse=True) and len(set(costs)) == len(costs)
    assert costs[-1] == pytest.approx(found["length"])
    if PEERS[planner].shortens and stop == "limit":
        assert found["length"] < 1.1 * 36.0


@with_the_wheel
@pytest.mark.parametrize("planner", PEERS)
def test_same_seed_same_search_however_warm(tmp_path, planner):
    folder = problems_folder(tmp_path)
    cold = "import peers.search as s; whole = s.answer_to; s.answer_to = lambda job: whole(job, warm_up=False)"
    runs = [answer(folder, planner), answer(folder, planner, cold), answer(folder, planner, seed=9)]
    counts = [(run["path"], run["nodes"], run["spent"][1:]) for run in runs]
    assert counts[0] == counts[1] != counts[2]


@with_the_wheel
def test_time_ends_a_search_without_a_way(tmp_path):
    free = np.ones((24, 32), dtype=bool)
    free[:, 15] = False
    for planner in PEERS:
        found = answer(problems_folder(tmp_path, free), planner, time_limit=0.2)
        assert found["status"] == "time_limit" and 200 <= found["plan_ms"] < 2000


@with_the_wheel
@pytest.mark.parametrize("planner", PEERS)
def test_paths_that_do_not_join_the_ends_are_no_solutions(tmp_path, planner):
    """AORRTC of 2.0.1 answers a query whose straight line is free with a path that never leaves the goal."""
    found = answer(problems_folder(tmp_path, np.ones((24, 32), dtype=bool)), planner)
    joins = found["path"][0] == pytest.approx([4.5, 4.5]) and found["path"][-1] == pytest.approx([27.5, 4.5])
    assert found["status"] == ("solved" if joins else "wrong_path")
    assert joins or (planner, WHEEL) == ("AORRTC", "2.0.1")


@with_the_wheel
def test_blocked_ends_are_found_before_searching(tmp_path):
    folder = problems_folder(tmp_path, problems__0__start_pixel=[15.5, 4.5])
    assert answer(folder, "RRTstar")["status"] == "start_occupied"
    folder = problems_folder(tmp_path, problems__0__goal_pixel=[40.0, 4.5])
    assert answer(folder, "RRTstar")["status"] == "goal_outside"


@with_the_wheel
def test_the_command_writes_a_result_that_the_report_reads(tmp_path):
    folder, out = problems_folder(tmp_path), tmp_path / "peers.json"
    words = [str(folder), "--json", str(out), "--planner", "RRTConnect", "--planner", "RRTstar"]
    run = CliRunner().invoke(app, words)
    assert run.exit_code == 0, run.stderr
    assert "RRT-Connect" in run.stdout and "2/2" in run.stdout
    results = load(out)
    assert isinstance(results, PlanResults) and len(results.runs) == 4 and all(r.solved for r in results.runs)
    assert results.baseline == f"RRT-Connect (PyPI ompl {WHEEL})"
    assert results.settings[f"RRT* (PyPI ompl {WHEEL})"].range == 2.0
    assert str(tmp_path) not in out.read_text()
