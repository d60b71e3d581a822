# SPDX-License-Identifier: BSD-3-Clause
"""``lrrt report``: numbers of hand-made results, broken files, figures, the page and the Markdown."""

from __future__ import annotations

import copy
import gzip
import json
import math
import os
import re
import tracemalloc
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.colors import to_hex
from typer.testing import CliRunner

from lrrt import cli
from lrrt.report import ResultError, fields, load, terminal_report
from lrrt.report import statistics as st
from lrrt.report import tables as tb
from lrrt.report.content import chapters
from lrrt.report.curves import cost_picture, costs_over_time, growth_pictures, success_picture
from lrrt.report.figures import heat_pictures, means_picture, predict_pictures
from lrrt.report.formatting import short_number
from lrrt.report.results import PlanResults, PredictResults, pairs_of
from lrrt.report.style import Look, looks
from lrrt.report.views import table_of
from lrrt.report.writing import write_file

GROUP = "mazes of 25×25 blocks"
HEAD = {
    "format": "lrrt_bench 1",
    "versions": {"lrrt": "0.1.0", "ompl": "1.5.2", "compiler": "gcc 12.2.0", "build": "Release"},
    "machine": {"processor": "A processor", "cores": 2, "system": "Linux"},
    "started": "2026-11-22 11:53:08",
}


def planner(name: str, strategy: str = "frontier", alpha: float = 0.8, model: str = "default") -> dict[str, Any]:
    settings = {"planner": "RRTstar", "strategy": strategy, "alpha": alpha, "model": model}
    return {"name": name, **settings, "range": 6.0, "stop": "first", "time_limit": 20.0}


def maze(name: str, level: int = 25, pixels: int = 256) -> dict[str, Any]:
    return {"kind": "maze", "name": name, "level": level, "pixels": pixels, "braid": 0.0, "count": 3, "seed": 1}


def failed(name: str, seed: int, group: str = GROUP) -> dict[str, Any]:
    return {
        "group": group,
        "map": f"{group} #0",
        "query": "farthest",
        "planner": name,
        "seed": seed,
        "solved": False,
        "iterations": 9000,
        "nodes": 4000,
        "times_ms": {"prepare": 1.0, "encode": 0.0, "infer": 0.0, "region": 0.0, "plan": 499.0, "total": 500.0},
    }


def solved(
    name: str, seed: int, search: float, group: str = GROUP, infer: float = 0.0, lengths: tuple[float, ...] = (120.0,)
) -> dict[str, Any]:
    """A run whose first path takes 1 ms to prepare, ``infer`` to predict and ``search``; optimum 100."""
    row = failed(name, seed, group)
    history = [[search * (i + 1), 10 * (i + 1), length] for i, length in enumerate(lengths)]
    times = {"prepare": 1.0, "encode": 0.0, "infer": infer, "region": 0.0, "plan": history[-1][0]}
    within = {str(p): next((1 + infer + t for t, _, cost in history if cost <= 100 + p), None) for p in (10, 5, 2, 1)}
    return row | {
        "solved": True,
        "iterations": int(10 * search),
        "nodes": int(5 * search),
        "times_ms": times | {"total": 1 + infer + history[-1][0]},
        "first_ms": 1 + infer + search,
        "search_ms": search,
        "length": lengths[-1],
        "optimum": 100.0,
        "within_ms": within,
        "history": history,
    }


def document(rows: list[dict[str, Any]], planners: list[dict[str, Any]], **suite: Any) -> dict[str, Any]:
    body = {"title": "A suite", "kind": "plan", "baseline": planners[0]["name"], "maps": [maze(GROUP)]}
    return copy.deepcopy({**HEAD, "suite": body | {"planners": planners} | suite, "rows": rows})


def two_planners(**suite: Any) -> dict[str, Any]:
    """RRT* solves seeds 1 to 3 of 4, the guided one 2 to 4."""
    rows = [solved("RRT*", seed, search) for seed, search in ((1, 100.0), (2, 200.0), (3, 400.0))]
    rows += [failed("RRT*", 4), failed("guided", 1)]
    rows += [solved("guided", seed, search, infer=4.0) for seed, search in ((2, 10.0), (3, 40.0), (4, 1.0))]
    return document(rows, [planner("RRT*", "uniform"), planner("guided")], **suite)


def predictions() -> dict[str, Any]:
    rows = [
        {"model": f"/models/{model}.onnx", "size": size, "threads": 1, "spinning": False, "times": [[1, 2, 3, 7]] * 4}
        for model in ("large", "small")
        for size in (128, 256)
    ]
    return {**HEAD, "suite": {"title": "Predictions", "kind": "predict"}, "rows": rows}


def written(folder: Path, content: dict[str, Any], name: str = "result.json") -> Path:
    (folder / name).write_text(json.dumps(content), encoding="utf-8")
    return folder / name


def loaded(folder: Path, content: dict[str, Any]) -> PlanResults:
    results = load(written(folder, content))
    assert isinstance(results, PlanResults)
    return results


def looks_of(results: PlanResults) -> dict[str, Look]:
    return looks(results.planners(), results.baseline)


def report(*words: object):
    return CliRunner().invoke(cli.app, ["report", *(str(word) for word in words)])


# Statistics


def test_median_and_quartiles_are_interpolated():
    s = st.summarize([4.0, 1.0, 3.0, 2.0])
    assert (s.count, s.lower, s.median, s.upper, s.mean) == (4, 1.75, 2.5, 3.25, 2.5)
    assert s.deviation == pytest.approx(math.sqrt(5 / 3))
    assert st.summarize([7.0]).median == 7.0 and math.isnan(st.summarize([7.0]).deviation)
    assert math.isnan(st.summarize([]).median)


@pytest.mark.parametrize(
    ("successes", "trials", "low", "high"),
    [(8, 10, 0.4902, 0.9433), (0, 10, 0.0, 0.2775), (10, 10, 0.7225, 1.0), (0, 0, 0.0, 1.0), (81, 263, 0.2553, 0.3662)],
)
def test_wilson_interval_is_the_published_one(successes, trials, low, high):
    assert st.wilson_interval(successes, trials) == pytest.approx((low, high), abs=5e-5)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0, "0"),
        (0.0199, "0.02"),
        (0.5, "0.500"),
        (1.234, "1.23"),
        (12.34, "12.3"),
        (122.5, "123"),
        (9999.4, "9999"),
        (23656.2, "23\u202f656"),
        (1234567, "1\u202f234\u202f567"),
        (math.nan, "-"),
        (math.inf, "inf"),
    ],
)
def test_numbers_are_short(value, text):
    assert short_number(value) == text


def test_ratios_leave_out_what_is_no_number():
    assert st.ratios([(6.0, 3.0), (1.0, 0.0), (math.nan, 1.0), (0.0, 2.0)]) == [2.0, 0.0]


# Tables


def test_medians_are_of_solved_runs(tmp_path):
    table = tb.medians_table(loaded(tmp_path, two_planners()), GROUP)
    rows = {row[0]: dict(zip(table.columns, row)) for row in table.rows}
    assert list(rows) == ["RRT*", "guided"]
    assert rows["RRT*"]["solved (95 % interval)"] == "3/4 (30 to 95 %)"
    assert rows["RRT*"]["first path, ms"] == "201 [151, 301]"
    assert rows["guided"]["prediction, ms"] == "4.00 [4.00, 4.00]"
    assert rows["guided"]["search, ms"] == "10.0 [5.50, 25.0]"
    assert rows["guided"]["length / optimum"] == "1.20 [1.20, 1.20]"


def test_gains_pair_only_runs_that_both_solved(tmp_path):
    results = loaded(tmp_path, two_planners())
    rows = results.rows(GROUP)
    assert [a.seed for a, _ in pairs_of(rows["RRT*"], rows["guided"])] == [2, 3]
    table = tb.gains_table(results, GROUP)
    assert table is not None and len(table.rows) == 1
    gains = dict(zip(table.columns, table.rows[0]))
    assert gains["pairs"] == "2" and gains["search"] == "15.0× [12.5, 17.5]"
    assert gains["first path"] == short_number((201 / 15 + 401 / 45) / 2) + "× [10.0, 12.3]"


def test_gains_need_a_baseline_and_another(tmp_path):
    only = document([solved("RRT*", 1, 10.0)], [planner("RRT*", "uniform")])
    assert tb.gains_table(loaded(tmp_path, only), GROUP) is None


def test_gains_are_told_against_each_rows_own_baseline(tmp_path):
    content = two_planners()
    content["suite"]["planners"].append({**planner("car"), "baseline": "guided"})
    content["rows"] += [solved("car", seed, 1.0) for seed in (1, 2)]
    results = loaded(tmp_path, content)
    assert [table.title for table in tb.gains_tables(results, GROUP)] == ["Gain over RRT*", "Gain over guided"]
    assert [row[0] for table in tb.gains_tables(results, GROUP) for row in table.rows] == ["guided", "car"]
    assert table_of(results, "gain").title == "first path, the baseline's ÷ the row's"


def test_hard_queries_are_those_that_cost_the_baseline_more_or_came_to_nothing(tmp_path):
    results = loaded(tmp_path, two_planners())
    table = tb.hard_table(results, results.groups())
    assert table is not None
    assert table.rows == [("guided", "3/4", "3/4", "0", "4", "2.81×", "11.2×", "62.4×", "0", "-", "-")]
    assert table_of(results, "hard") == table
    assert table_of(results, "hard:groups").rows == [(GROUP, *table.rows[0])]
    easy = document(
        [solved("RRT*", 1, 4.0), solved("guided", 1, 2.0, infer=5.0)], [planner("RRT*", "uniform"), planner("guided")]
    )
    table = tb.hard_table(loaded(tmp_path, easy), [GROUP])
    assert table is not None
    assert table.rows == [("guided", "1/1", "1/1", "0", "0", "-", "-", "-", "1", "8.00", "10.0")]
    neither = document([failed("RRT*", 1), failed("guided", 1)], [planner("RRT*", "uniform"), planner("guided")])
    table = tb.hard_table(loaded(tmp_path, neither), [GROUP])
    assert table is not None and table.rows[0][1:5] == ("0/1", "0/1", "1", "0")
    unguided = document([solved("RRT*", 1, 4.0)], [planner("RRT*", "uniform")])
    assert tb.hard_table(loaded(tmp_path, unguided), [GROUP]) is None
    with pytest.raises(ResultError, match="no such pair"):
        table_of(loaded(tmp_path, unguided), "hard")


def test_times_to_the_optimum_count_all_runs(tmp_path):
    rows = [solved("RRT*", 1, 10.0, lengths=(120.0, 104.0, 100.5)), solved("RRT*", 2, 10.0), failed("RRT*", 3)]
    table = tb.within_table(loaded(tmp_path, document(rows, [planner("RRT*", "uniform")])), GROUP)
    assert table is not None
    assert table.rows == [("RRT*", "21.0 (1/3)", "21.0 (1/3)", "31.0 (1/3)", "31.0 (1/3)")]
    assert tb.within_table(loaded(tmp_path, two_planners()), GROUP) is None


def test_lengths_without_an_optimum_are_left_out(tmp_path):
    content = two_planners()
    for row in content["rows"]:
        row["optimum"] = None
    assert all(row[-1] == "-" for row in tb.medians_table(loaded(tmp_path, content), GROUP).rows)


def test_predictions_are_summed_up(tmp_path):
    results = load(written(tmp_path, predictions()))
    assert isinstance(results, PredictResults)
    row = tb.predict_table(results).rows[0]
    assert row[:6] == ("large.onnx", "128²", "-", "1", "off", "1") and row[-2:] == ("7.00 (7.00)", "143")


def test_predictions_tell_batches_and_pictures(tmp_path):
    content = predictions()
    content["rows"][1] |= {"batch": 8, "input_sides": [192, 256]}
    content["versions"]["libtorch"] = "1.13.1"
    file = written(tmp_path, content)
    results = load(file)
    assert isinstance(results, PredictResults)
    assert tb.predict_table(results).rows[1][:6] == ("large.onnx", "256²", "192², 256²", "1", "off", "8")
    assert "libtorch 1.13.1" in terminal_report(file)
    labels = [label.get_text() for label in predict_pictures(results)[0].figure.axes[1].get_yticklabels()]
    assert labels == ["large.onnx, 1 thread, batches of 8", "small.onnx, 1 thread"]


@pytest.mark.parametrize("sides", [192, [], [192.5], [True], ["192"]])
def test_sides_of_pictures_are_checked(tmp_path, sides):
    content = predictions()
    content["rows"][0]["input_sides"] = sides
    with pytest.raises(ResultError, match=r"'rows\[0\].input_sides'.*whole numbers"):
        load(written(tmp_path, content))


# Broken files


def without(*keys: Any) -> dict[str, Any]:
    content = two_planners()
    place: Any = content
    for key in keys[:-1]:
        place = place[key]
    del place[keys[-1]]
    return content


def changed(value: Any, *keys: Any) -> dict[str, Any]:
    content = two_planners()
    place: Any = content
    for key in keys[:-1]:
        place = place[key]
    place[keys[-1]] = value
    return content


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("{", ["is not JSON", "lrrt_bench --json"]),
        ("[]", ["no JSON object"]),
        ("[" * 5000, ["is not JSON"]),
        (b"\xff\xfe", ["is no text"]),
        (changed("lrrt_bench 2", "format"), ["'format'", "lrrt_bench 1"]),
        (without("format"), ["'format' is missing"]),
        (without("suite", "baseline"), ["'suite.baseline' is missing", "a text"]),
        (changed("fly", "suite", "kind"), ["'suite.kind'", "'plan' or 'predict'"]),
        (changed([], "rows"), ["'rows' is []", "at least one run"]),
        (changed([3], "rows"), ["'rows[0]' is 3", "an object"]),
        (without("rows", 2, "seed"), ["'rows[2].seed' is missing", "a whole number"]),
        (without("rows", 0, "first_ms"), ["'rows[0].first_ms' is missing"]),
        (changed("soon", "rows", 1, "times_ms", "infer"), ["'rows[1].times_ms.infer' is \"soon\"", "a finite number"]),
        (changed(math.nan, "rows", 1, "length"), ["'rows[1].length'", "a finite number"]),
        (changed(10**400, "rows", 1, "nodes"), ["'rows[1].nodes'", "a whole number"]),
        (changed(1e308, "rows", 0, "first_ms"), ["'rows[0].first_ms' is 1e+308", "below 1e15"]),
        (changed(-1e15, "rows", 1, "times_ms", "total"), ["'rows[1].times_ms.total'", "below 1e15"]),
        (changed(10**17, "rows", 1, "times_ms", "total"), ["'rows[1].times_ms.total'", "below 1e15"]),
        (changed([[1e300, 1, 2]], "rows", 0, "history"), ["'rows[0].history'", "[milliseconds, iteration, length]"]),
        (changed("yes", "rows", 0, "solved"), ["'rows[0].solved'", "true or false"]),
        (changed([[1, 2]], "rows", 0, "history"), ["'rows[0].history'", "[milliseconds, iteration, length]"]),
    ],
)
def test_broken_files_exit_with_2_and_name_file_and_field(tmp_path, content, words):
    file = tmp_path / "broken.json"
    text = json.dumps(content) if isinstance(content, dict) else content
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    run = report(file, "--output", tmp_path / "out.html")
    assert run.exit_code == 2 and run.stderr.startswith("error:") and "Traceback" not in run.stderr
    assert all(word in run.stderr for word in ["broken.json", *words]), run.stderr
    assert not (tmp_path / "out.html").exists()


def test_folders_and_missing_files_are_refused(tmp_path):
    for name in (tmp_path, tmp_path / "missing.json"):
        run = report(name, "--output", tmp_path / "out.html")
        assert run.exit_code == 2 and str(name) in run.stderr and "cannot be read" in run.stderr


def test_pipes_and_devices_are_refused_rather_than_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe.json")
    for name in (tmp_path / "pipe.json", "/dev/zero"):
        with pytest.raises(ResultError, match=r"cannot be read \(not a regular file\)"):
            load(name)


@pytest.mark.parametrize("pack", [bytes, gzip.compress])
def test_files_that_hold_too_much_are_refused_before_they_are_unpacked(tmp_path, monkeypatch, pack):
    text = json.dumps(predictions())
    monkeypatch.setattr(fields, "MOST_BYTES", len(text))
    file = tmp_path / "result.json"
    file.write_bytes(pack(text.encode()))
    load(file)
    file.write_bytes(pack(text.encode() + b" " * 100_000_000))
    tracemalloc.start()
    with pytest.raises(ResultError, match=rf"result\.json: holds more than {len(text)} bytes"):
        load(file)
    assert tracemalloc.get_traced_memory()[1] < 10_000_000
    tracemalloc.stop()


@pytest.mark.parametrize("end", [-1, 20])
def test_gzipped_files_that_are_broken_are_named(tmp_path, end):
    (tmp_path / "result.json.gz").write_bytes(gzip.compress(json.dumps(predictions()).encode())[:end])
    with pytest.raises(ResultError, match=r"result\.json\.gz: is gzipped, but broken"):
        load(tmp_path / "result.json.gz")


def test_an_interrupted_run_is_told_from_a_broken_file(tmp_path):
    (tmp_path / "a.json.part").write_text('{"suite": {}}\n{"id": "x"}\n')
    with pytest.raises(ResultError, match=r"interrupted.*report a\.json"):
        load(tmp_path / "a.json.part")


def test_outputs_that_cannot_be_written_exit_with_2(tmp_path):
    file = written(tmp_path, predictions())
    for words in (
        ("--output", file),
        ("--output", tmp_path),
        ("--output", tmp_path / "no" / "folder.html"),
        ("--output", tmp_path / "a", "--markdown", tmp_path / "a"),
        ("--output", tmp_path / "a", "--figures", file),
    ):
        run = report(file, *words)
        assert run.exit_code == 2 and str(words[-1]) in run.stderr and "expected" in run.stderr
    assert json.loads(file.read_text()) == predictions()
    assert not list(tmp_path.glob(".*"))


def test_links_are_followed_and_pipes_stay(tmp_path):
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "link").symlink_to("elsewhere/page")
    (tmp_path / "other").symlink_to("pipe")
    os.mkfifo(tmp_path / "pipe")  # stands for devices, too: one that was lost would be missed
    reader = os.open(tmp_path / "pipe", os.O_RDONLY | os.O_NONBLOCK)
    for name in ("link", "link", "pipe", "other"):  # the link's file is not there at first
        write_file(tmp_path / name, "text")
    assert os.read(reader, 100) == b"texttext"
    os.close(reader)
    assert (tmp_path / "link").is_symlink() and (tmp_path / "elsewhere/page").read_text() == "text"
    assert (tmp_path / "other").is_symlink() and (tmp_path / "pipe").is_fifo()
    assert sorted(path.name for path in tmp_path.rglob("*")) == ["elsewhere", "link", "other", "page", "pipe"]


def test_outputs_that_fail_while_they_are_written_exit_with_2(tmp_path):
    file = written(tmp_path, predictions())
    (tmp_path / "circle").symlink_to("circle")
    for output in (tmp_path / "circle", tmp_path / ("x" * 255), tmp_path / ("x" * 256)):
        run = report(file, "--output", output)
        assert run.exit_code == 2 and "cannot be written" in run.stderr and "expected" in run.stderr, run.output
    assert (tmp_path / "circle").is_symlink() and not list(tmp_path.glob(".*"))


# Figures


def test_costs_over_time_count_runs_without_a_path_as_endless(tmp_path):
    rows = [solved("RRT*", 1, 10.0, lengths=(150.0, 110.0)), solved("RRT*", 2, 30.0), failed("RRT*", 3)]
    results = loaded(tmp_path, document(rows, [planner("RRT*", "uniform")]))
    times = np.array([5.0, 11.0, 21.0, 31.0])
    lower, median, upper = costs_over_time(results.runs, times)
    np.testing.assert_allclose(lower, [np.inf, np.inf, np.inf, 1.15])
    np.testing.assert_allclose(median, [np.inf, np.inf, np.inf, 1.2])
    np.testing.assert_allclose(upper, np.inf)
    np.testing.assert_allclose(costs_over_time(results.runs[:1], times)[1], [np.inf, 1.5, 1.1, 1.1])


def test_cost_is_drawn_only_where_paths_were_improved(tmp_path):
    rows = [solved(name, 1, 10.0, lengths=(150.0, 110.0)) for name in ("RRT*", "_guided $x$")]
    results = loaded(tmp_path, document(rows, [planner("RRT*"), planner("_guided $x$")]))
    picture = cost_picture(results, GROUP, looks_of(results))
    assert picture is not None
    (axes,) = picture.figure.axes
    assert len(axes.lines) == len(axes.collections) == 2 and axes.get_xscale() == "log"
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("time since the call, ms", "length / optimum")
    assert len(axes.get_legend().get_texts()) == 2
    plain = loaded(tmp_path, two_planners())
    assert cost_picture(plain, GROUP, looks_of(plain)) is None


def test_success_ends_at_the_share_that_was_solved(tmp_path):
    results = loaded(tmp_path, two_planners())
    picture = success_picture(results, GROUP, looks_of(results))
    assert picture is not None
    (axes,) = picture.figure.axes
    assert [line.get_label() for line in axes.lines] == ["RRT*", "guided"]
    assert all(line.get_ydata()[-1] == 75 for line in axes.lines)
    assert "ms" in axes.get_xlabel() and "%" in axes.get_ylabel()


def test_bars_show_the_means(tmp_path):
    results = loaded(tmp_path, two_planners())
    axes = means_picture(results, looks_of(results)).figure.axes
    assert [a.get_xlabel().removesuffix(" (logarithmic)") for a in axes] == [
        "iterations",
        "nodes of the tree",
        "time to the first path, ms",
    ]
    ends = [bar.get_x() + bar.get_width() for bar in axes[0].patches]
    assert ends == pytest.approx([10 * 700 / 3, 10 * 51 / 3])
    assert [label.get_text() for label in axes[0].get_yticklabels()] == ["RRT*  3/4", "guided  3/4"]


def test_growth_needs_several_sizes_of_one_kind(tmp_path):
    maps = [maze("a", level=25), maze("b", level=35), maze("c", level=45) | {"braid": 0.5}]
    rows = [solved(name, 1, 10.0, group, infer) for group in "abc" for name, infer in (("RRT*", 0.0), ("guided", 4.0))]
    results = loaded(tmp_path, document(rows, [planner("RRT*", "uniform"), planner("guided")], maps=maps))
    (picture,) = growth_pictures(results, looks_of(results))
    axes = picture.figure.axes
    assert [a.get_ylabel() for a in axes] == ["prediction, ms", "search, ms", "call to first path, ms"]
    assert all(a.get_xscale() == a.get_yscale() == "log" and "blocks" in a.get_xlabel() for a in axes)
    assert all(len(a.lines) == 2 for a in axes)
    np.testing.assert_allclose(axes[0].lines[1].get_xydata(), [[25, 4], [35, 4]])
    one = loaded(tmp_path, two_planners())
    assert growth_pictures(one, looks_of(one)) == []


def test_a_heat_map_needs_several_alphas_and_models(tmp_path):
    names = {(a, m): f"g {a} {m}" for a in (0.5, 0.9) for m in ("default", "astar", "full")}
    rows = [solved(name, 1, 1 + i) for i, name in enumerate(names.values())]
    planners = [planner(name, alpha=a, model=m) for (a, m), name in names.items()]
    results = loaded(tmp_path, document(rows, planners))
    (picture,) = heat_pictures(results, GROUP)
    axes, bar = picture.figure.axes
    assert [t.get_text() for t in axes.get_xticklabels()] == ["default", "astar", "full"]
    assert [t.get_text() for t in axes.get_yticklabels()] == ["0.5", "0.9"]
    assert [t.get_text() for t in axes.texts] == ["2.00", "3.00", "4.00", "5.00", "6.00", "7.00"]
    assert "ms" in bar.get_ylabel()
    assert heat_pictures(loaded(tmp_path, two_planners()), GROUP) == []


def test_stages_of_predictions_are_stacked(tmp_path):
    results = load(written(tmp_path, predictions()))
    assert isinstance(results, PredictResults)
    axes = predict_pictures(results)[0].figure.axes
    assert [a.get_title(loc="left") for a in axes] == ["maps of 128×128 pixels", "maps of 256×256 pixels"]
    assert [(bar.get_x(), bar.get_width()) for bar in axes[0].patches[:3]] == [(0, 1), (1, 2), (3, 3)]
    assert len(axes[0].patches) == 2 * 3 and "ms" in axes[-1].get_xlabel()


def test_planners_keep_their_colours(tmp_path):
    results = loaded(tmp_path, two_planners())
    all_looks = looks_of(results)
    success = success_picture(results, GROUP, all_looks)
    assert success is not None
    lines = success.figure.axes[0].lines
    bars = means_picture(results, all_looks).figure.axes[0].patches
    assert [to_hex(line.get_color()) for line in lines] == [to_hex(bar.get_facecolor()) for bar in bars]
    many = looks([f"planner {i}" for i in range(20)], "planner 0")
    assert len({(look.colour, look.line) for look in many.values()}) == 20


# Page and Markdown


class Page(HTMLParser):
    """Checks that elements nest, and keeps what matters of them."""

    VOID = frozenset({"meta", "br", "hr", "img", "link", "input"})

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.ids: list[str] = []
        self.links: list[str] = []
        self.tags: set[str] = set()
        self.words = ""
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.handle_startendtag(tag, attrs)
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.add(tag)
        self.ids += [value or "" for name, value in attrs if name == "id"]
        self.links += [value or "" for name, value in attrs if name in ("href", "src", "xlink:href", "data")]

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.words += data


@pytest.fixture(scope="module")
def both(tmp_path_factory) -> Path:
    """A folder with the report of two files, made by the command."""
    folder = tmp_path_factory.mktemp("report")
    plan = written(folder, two_planners(title='Guided <b>& "quick"</b>'), "a plan.json")
    predict = written(folder, predictions(), "predict.json")
    outputs = ("--output", folder / "out.html", "--figures", folder / "fig", "--markdown", folder / "out.md")
    run = report(plan, predict, *outputs)
    assert run.exit_code == 0 and run.stderr == ""
    paths = [Path(line) for line in run.stdout.splitlines()]
    assert paths[0] == folder / "out.html" and all(path.is_file() for path in paths)
    return folder


def test_the_page_needs_nothing_else(both):
    text = (both / "out.html").read_text(encoding="utf-8")
    page = Page(text)
    assert "http" not in text and not {"script", "link", "img", "iframe"} & page.tags
    assert page.links and all(link.startswith("#") for link in page.links)
    assert {link[1:] for link in page.links} <= set(page.ids) and len(page.ids) == len(set(page.ids))
    assert {"svg", "table", "figcaption"} <= page.tags and "prefers-color-scheme: dark" in text
    assert set(re.findall(r"url\((.)", text)) <= {"#"}


def test_the_page_says_what_was_measured_and_escapes_it(both):
    text = (both / "out.html").read_text(encoding="utf-8")
    words = Page(text).words
    assert 'Guided <b>& "quick"</b>' in words and "Guided &lt;b&gt;&amp; &quot;quick&quot;&lt;/b&gt;" in text
    for expected in ("A processor, 2 cores", "OMPL 1.5.2", "2026-11-22 11:53:08 UTC", GROUP, "Predictions"):
        assert expected in words
    assert "lrrt_bench --replay 'a plan.json'" in words and "3/4" in words


def test_markdown_tables_have_as_many_cells_as_columns(both):
    text = (both / "out.md").read_text(encoding="utf-8")
    blocks = [block.splitlines() for block in text.split("\n\n") if block.startswith("|")]
    assert len(blocks) == 6  # medians, hard, gains, means, settings; predictions
    for lines in blocks:
        assert len({len(re.findall(r"(?<!\\)\|", line)) for line in lines}) == 1
    assert "RRT\\*" in text and "\\<b\\>" in text


def test_markdown_links_to_the_figures(both):
    links = re.findall(r"!\[[^]]*\]\(([^)]*)\)", (both / "out.md").read_text(encoding="utf-8"))
    assert sorted(links) == sorted(f"fig/{path.name}" for path in (both / "fig").iterdir())
    assert len(links) == 3 and all("<svg" in (both / link).read_text(encoding="utf-8") for link in links)


def test_nothing_temporary_stays(both):
    assert not [path for path in both.rglob("*") if path.name.startswith(".") or path.suffix == ".part"]


def test_names_of_figures_are_their_own(tmp_path):
    maps = [maze("loops!"), maze("loops?")]
    rows = [solved("RRT*", 1, 10.0, group) for group in ("loops!", "loops?")]
    results = loaded(tmp_path, document(rows, [planner("RRT*")], maps=maps))
    names = [p.name for chapter in chapters([results, results]) for s in chapter.sections for p in s.pictures]
    assert len(names) == len(set(names)) and "result-success-loops" in names and "result-success-loops-2" in names


def test_suites_without_any_path_have_tables_and_no_figures(tmp_path):
    results = loaded(tmp_path, document([failed("RRT*", 1), failed("guided", 1)], [planner("RRT*"), planner("guided")]))
    (chapter,) = chapters([results])
    (section,) = chapter.sections
    assert section.pictures == [] and section.tables[0].rows[0][:3] == ("RRT*", "0/1 (0 to 79 %)", "-")


def test_help_teaches():
    run = report("--help")
    assert run.exit_code == 0 and "lrrt_bench" in run.stdout and "--markdown" in run.stdout
