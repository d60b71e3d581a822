# SPDX-License-Identifier: BSD-3-Clause
"""``docs/make_benchmarks.py``: the committed page, slimmed and gzipped results, views, marks that make no sense."""

from __future__ import annotations

import gzip
import importlib.util
import json
import re
import shutil
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from test_report import (
    GROUP,
    document,
    failed,
    loaded,
    maze,
    planner,
    predictions,
    report,
    solved,
    two_planners,
    written,
)
from typer.testing import CliRunner

from lrrt.report import PlanResults, PredictResults, ResultError, load
from lrrt.report import tables as tb
from lrrt.report.content import chapters
from lrrt.report.curves import costs_over_time, visible_steps
from lrrt.report.slimming import slimmed, store, thinned
from lrrt.report.views import VIEWS, group_labels, table_of

DOCS = Path(__file__).parents[2] / "docs"


def script() -> ModuleType:
    spec = importlib.util.spec_from_file_location("make_benchmarks", DOCS / "make_benchmarks.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # dataclasses look their module up
    spec.loader.exec_module(module)
    return module


PAGES = script()


def make(*words: object, docs: Path = DOCS):
    return CliRunner().invoke(PAGES.app, ["--docs", str(docs), *(str(word) for word in words)])


def converging(group: str = GROUP) -> dict[str, Any]:
    """Two planners whose paths get shorter in thousands of small steps; a third of the runs find none."""
    lengths = {
        name: tuple((100 + 60 * np.exp(-np.arange(1500) / pace)).tolist())
        for name, pace in (("RRT*", 900), ("guided", 100))
    }
    rows = [solved(name, seed, 0.5 + seed / 7, group, lengths=lengths[name]) for name in lengths for seed in (1, 2)]
    rows += [failed(name, 3, group) for name in lengths]
    return document(rows, [planner("RRT*", "uniform"), planner("guided")], maps=[maze(group)])


@pytest.fixture(scope="module")
def made(tmp_path_factory) -> Path:
    """A small page with two results, made by the program."""
    folder = tmp_path_factory.mktemp("docs")
    for name, content in (("plan", converging()), ("predict", predictions())):
        run = make("add", written(folder, content), "--name", name, docs=folder)
        assert run.exit_code == 0, run.stderr
    marks = ("plan within figure:success-mazes-of-25x25-blocks facts", "predict")
    text = "".join(f"By hand.\n\n<!-- results: {mark} -->\n<!-- end of results -->\n" for mark in marks)
    (folder / "benchmarks.md").write_text(text, encoding="utf-8")
    assert make(docs=folder).exit_code == 0
    return folder


@pytest.fixture
def docs(made, tmp_path) -> Path:
    """A copy of the small page, to be changed."""
    return Path(shutil.copytree(made, tmp_path / "docs"))


def all_tables(results: PlanResults | PredictResults) -> list[Any]:
    (chapter,) = chapters([results])
    return [chapter.facts, chapter.settings, *(section.tables for section in chapter.sections)]


def cells(table: tb.Table) -> dict[str, dict[str, str]]:
    return {row[0]: dict(zip(table.columns[1:], row[1:])) for row in table.rows}


# The committed page


def test_the_page_is_what_the_results_give():
    run = make("--check")
    assert run.exit_code == 0, run.output


def test_a_changed_number_is_noticed_and_mended(docs):
    page = docs / "benchmarks.md"
    good = page.read_text(encoding="utf-8")
    number = re.compile(r"\d+\.\d+").search(good, good.index("<!-- results: "))
    assert number is not None
    page.write_text(f"{good[: number.start()]}7777.7{good[number.end() :]}", encoding="utf-8")
    run = make("--check", docs=docs)
    assert run.exit_code == 1 and "7777.7" in run.stdout and number[0] in run.stdout
    assert "7777.7" in page.read_text(encoding="utf-8")
    assert make(docs=docs).exit_code == 0 and page.read_text(encoding="utf-8") == good
    assert make("--check", docs=docs).exit_code == 0


def test_another_result_is_noticed(docs):
    other = predictions()
    other["rows"][0]["times"] = [[1, 2, 3, 8]] * 4
    assert make("add", written(docs, other), "--name", "predict", docs=docs).exit_code == 0
    run = make("--check", docs=docs)
    assert run.exit_code == 1 and "-| large.onnx" in run.stdout and "+| large.onnx" in run.stdout


def test_what_is_written_by_hand_stays(docs):
    page = docs / "benchmarks.md"
    text = (
        "# Title\n"
        + page.read_text(encoding="utf-8").replace("By hand.", "Other words, 7777.7")
        + "\nThe end, no newline"
    )
    page.write_text(text, encoding="utf-8")
    assert make("--check", docs=docs).exit_code == 0
    assert make(docs=docs).exit_code == 0 and page.read_text(encoding="utf-8") == text


def test_figures_are_those_that_the_page_shows(docs):
    shown = "bench-plan-success-mazes-of-25x25-blocks.svg"
    assert [path.name for path in (docs / "images").iterdir()] == [shown]
    assert f"](images/{shown})" in (docs / "benchmarks.md").read_text(encoding="utf-8")
    (docs / "images" / shown).unlink()
    (docs / "images" / "bench-old.svg").touch()
    (docs / "images" / "other.svg").touch()
    run = make("--check", docs=docs)
    assert run.exit_code == 1 and f"{shown}: is missing" in run.stdout
    run = make(docs=docs)
    assert run.exit_code == 0 and "bench-old.svg: removed" in run.stdout
    assert sorted(path.name for path in (docs / "images").iterdir()) == [shown, "other.svg"]


def test_committed_files_are_small_and_name_no_folder_of_a_machine():
    assert all(file.stat().st_size < 100_000 for file in (DOCS / "images").glob("bench-*"))
    for file in (DOCS / "results").iterdir():
        assert file.name.endswith(".json.gz") and file.stat().st_size < 250_000
        text = gzip.decompress(file.read_bytes()).decode()
        assert json.loads(text)["folder"] in ("bench/suites", ".")
        assert not re.search(r'"/[^"]', text), "no absolute path"


# Slimmed results


def test_slimming_keeps_every_table(tmp_path):
    source = written(tmp_path, converging())
    before, after = store(source, tmp_path / "slim.json.gz")
    assert before == source.stat().st_size and after == (tmp_path / "slim.json.gz").stat().st_size < before / 10
    assert all_tables(load(tmp_path / "slim.json.gz")) == all_tables(load(source))
    content = predictions()
    store(written(tmp_path, content), tmp_path / "predict.json.gz")
    assert json.loads(gzip.decompress((tmp_path / "predict.json.gz").read_bytes())) == content


def test_slimming_keeps_all_but_steps_that_do_not_matter():
    content = converging()
    slim = slimmed(content)
    for row, thin in zip(content["rows"], slim["rows"]):
        assert {**row, "history": None} == {**thin, "history": None}
        if row["solved"]:
            assert thin["history"][0] == row["history"][0] and thin["history"][-1] == row["history"][-1]
            assert len(thin["history"]) < len(row["history"]) / 4
    assert {**slim, "rows": None} == {**content, "rows": None}
    assert slimmed(slim) == slim


def test_slimming_does_not_move_a_curve(tmp_path):
    full = loaded(tmp_path, converging())
    store(tmp_path / "result.json", tmp_path / "slim.json.gz")
    slim = load(tmp_path / "slim.json.gz")
    assert isinstance(slim, PlanResults)
    times = np.geomspace(1, 4000, 500)
    for name, runs in full.rows(GROUP).items():
        for was, now in zip(costs_over_time(runs, times), costs_over_time(slim.rows(GROUP)[name], times)):
            np.testing.assert_allclose(now, was, rtol=0.0015)


def test_short_histories_stay():
    assert thinned([[1.23456789, 10, 120.123456789]]) == [[1.23456789, 10, 120.123456789]]
    steps = [[1.0, 1, 200.0], [2.0, 2, 199.9], [3.0, 3, 190.0], [4.0, 4, 189.99]]
    assert thinned(steps) == [steps[0], steps[2], steps[3]]


@pytest.mark.parametrize(
    ("folder", "kept"), [("../../../clone/bench/suites", "bench/suites"), ("../../somewhere", "."), ("", ".")]
)
def test_folders_are_told_relative_to_the_repository(folder, kept):
    assert slimmed({**two_planners(), "folder": folder})["folder"] == kept


def test_same_result_same_file(tmp_path):
    for name in ("a.json.gz", "b.json.gz"):
        store(written(tmp_path, converging()), tmp_path / name)
    assert (tmp_path / "a.json.gz").read_bytes() == (tmp_path / "b.json.gz").read_bytes()


# Gzipped files


def test_gzipped_results_are_read(tmp_path):
    plain = written(tmp_path, two_planners(title=""))
    zipped = tmp_path / "result.json.gz"
    zipped.write_bytes(gzip.compress(plain.read_bytes()))
    assert all_tables(load(zipped)) == all_tables(load(plain))
    assert load(zipped).head.name == load(zipped).head.title == "result"
    run = report(zipped, "--output", tmp_path / "out.html", "--markdown", tmp_path / "out.md")
    assert run.exit_code == 0, run.stderr
    command = "zcat result.json.gz | lrrt_bench --replay /dev/stdin"
    assert command in (tmp_path / "out.md").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (gzip.compress(b'{"format": "lrrt_bench 1"}' * 9)[:-12], "is gzipped, but broken"),
        (b"\x1f\x8b nothing", "is gzipped, but broken"),
        (gzip.compress(b"{"), "is not JSON"),
        (gzip.compress(b"\xff\xfe"), "is no text"),
        (gzip.compress(b"{}"), "'format' is missing"),
    ],
)
def test_broken_gzipped_files_exit_with_2(tmp_path, content, words):
    (tmp_path / "a.json.gz").write_bytes(content)
    run = report(tmp_path / "a.json.gz", "--output", tmp_path / "out.html")
    assert run.exit_code == 2 and "a.json.gz" in run.stderr and words in run.stderr, run.stderr
    assert make("add", tmp_path / "a.json.gz", docs=tmp_path).exit_code == 2
    assert not list((tmp_path / "results").glob("*"))


# Views


def test_views_have_the_numbers_of_the_reports_tables(tmp_path):
    results = loaded(tmp_path, two_planners())
    medians, gains = cells(tb.medians_table(results, GROUP)), cells(tb.gains_table(results, GROUP))
    for view, column in (("first-path", "first path, ms"), ("search", "search, ms"), ("iterations", "iterations")):
        for name, row in cells(table_of(results, view)).items():
            assert row[GROUP] == medians[name][column].split(" [")[0] + " (3 of 4)"
    for view, column in (("gain", "first path"), ("gain:search", "search"), ("gain:length", "length")):
        ((name, row),) = cells(table_of(results, view)).items()
        assert name == "guided" and row[GROUP] == gains["guided"][column].split(" [")[0] + " (2 of 4)"
    assert cells(table_of(results, "success"))["guided"][GROUP] == "3/4 (30 to 95 %)"


def test_the_slowest_counts_runs_without_a_path(tmp_path):
    rows = [solved(name, seed, 10.0 * seed) for name in ("RRT*", "guided") for seed in range(1, 10)]
    results = loaded(
        tmp_path,
        document([*rows, solved("RRT*", 10, 500.0), failed("guided", 10)], [planner("RRT*"), planner("guided")]),
    )
    slowest, last = (cells(table_of(results, word)) for word in ("slowest", "slowest:100"))
    assert float(slowest["RRT*"][GROUP]) == float(slowest["guided"][GROUP]) < 200
    assert float(last["RRT*"][GROUP]) > 400 and last["guided"][GROUP] == "more runs failed"


def test_times_to_the_optimum_tell_how_many_came_there(tmp_path):
    rows = [solved(name, seed, 10.0, lengths=(120.0, 101.5)) for name in ("RRT*", "guided") for seed in (1, 2)]
    results = loaded(tmp_path, document([*rows, failed("guided", 3)], [planner("RRT*"), planner("guided")]))
    near = cells(tb.within_table(results, GROUP))
    table = table_of(results, "within")
    assert cells(table) == {"RRT*": {GROUP: "21.0"}, "guided": {GROUP: "21.0 (2 of 3)"}}
    assert near["guided"]["within 2 %"] == "21.0 (2/3)" and table.best == {(0, 1)}
    assert cells(table_of(results, "within:1"))["RRT*"][GROUP] == "- (0 of 2)"


def test_the_best_is_bold_where_it_speaks_for_as_many_runs(tmp_path):
    rows = [solved("RRT*", 1, 100.0), solved("RRT*", 2, 100.0), solved("fast", 1, 1.0), failed("fast", 2)]
    results = loaded(tmp_path, document(rows, [planner("RRT*"), planner("fast")]))
    assert table_of(results, "search").best == {(0, 1)}
    assert table_of(results, "gain").best == frozenset()


def test_predictions_leave_out_what_is_the_same_everywhere(tmp_path):
    results = load(written(tmp_path, predictions()))
    assert isinstance(results, PredictResults)
    report_table = tb.predict_table(results)
    table = table_of(results, "predict")
    assert table.columns == (*report_table.columns[:2], *report_table.columns[6:])
    assert table.rows == [(*row[:2], *row[6:]) for row in report_table.rows]


def test_groups_have_short_names_where_the_program_named_them(tmp_path):
    names = [f"mazes of {level}×{level} blocks on {side} pixels" for level, side in ((15, 256), (25, 512))]
    maps = [maze(names[0], 15) | {"braid": 0.5}, maze(names[1], 25, 512), maze("mine", 25)]
    rows = [solved("RRT*", 1, 1.0, group) for group in (*names, "mine")]
    labels = group_labels(loaded(tmp_path, document(rows, [planner("RRT*")], maps=maps)))
    assert list(labels.values()) == ["15 blocks, 256 pixels, loops", "25 blocks, 512 pixels", "mine"]


def test_many_groups_become_rows(tmp_path):
    groups = [f"g{i}" for i in range(9)]
    rows = [solved(name, 1, 1.0 + i, g) for g in groups for i, name in enumerate(("RRT*", "guided"))]
    content = document(rows[:-1], [planner("RRT*"), planner("guided")], maps=[maze(g) for g in groups])
    table = table_of(loaded(tmp_path, content), "search")
    assert table.columns == ("search, ms", "RRT*", "guided") and [row[0] for row in table.rows] == groups
    assert table.rows[0] == ("g0", "1.00", "2.00") and table.rows[-1] == ("g8", "1.00", "")
    assert table.best == {(i, 1) for i in range(8)}


def test_only_steps_that_show_are_drawn():
    costs = np.array([[np.inf, np.inf, 1.5, 1.4999, 1.4998, 1.2, 1.2], [np.inf] * 4 + [9.0] * 3])
    assert visible_steps(costs, 0.01) == [0, 2, 4, 5, 6]


# What is refused


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("<!-- results: nothing facts -->", ["no result 'nothing'", "one of plan, predict"]),
        ("<!-- results: plan frist-path -->", ["'frist-path'", "first-path, slowest, search", "facts, figure:NAME"]),
        ("<!-- results: plan predict -->", ["'predict'", "kind plan", "first-path"]),
        ("<!-- results: predict first-path -->", ["'first-path'", "kind predict", "one of predict, facts"]),
        ("<!-- results: plan within:3 -->", ["'within:3'", "within:2, within:10, within:5, within:1"]),
        ("<!-- results: plan search:1 -->", ["'search:1'", "expected one of search"]),
        ("<!-- results: plan figure:x -->", ["no figure 'x'", "one of figure:means, figure:cost-"]),
        ("<!-- results: -->", ["names no result"]),
    ],
)
def test_unknown_names_are_answered_with_those_that_exist(docs, text, words):
    (docs / "benchmarks.md").write_text(f"# Page\n\n{text}\n<!-- end of results -->\n", encoding="utf-8")
    for options in ((), ("--check",)):
        run = make(*options, docs=docs)
        assert run.exit_code == 2 and run.stdout == ""
        assert all(word in run.stderr for word in ["benchmarks.md:3:", *words]), run.stderr


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("<!-- results: plan -->\n", 2),
        ("<!-- end of results -->\n", 2),
        ("<!-- results: plan -->\n<!-- results: plan -->\n<!-- end of results -->\n", 2),
        ("<!-- results: plan -->\n<!-- end of results -->\n<!-- end of results -->\n", 4),
    ],
)
def test_marks_come_in_pairs(docs, text, line):
    (docs / "benchmarks.md").write_text(f"# Page\n{text}", encoding="utf-8")
    run = make(docs=docs)
    assert run.exit_code == 2 and f"benchmarks.md:{line}: a mark stands alone" in run.stderr


def test_marks_without_views_show_the_usual(docs):
    marks = "".join(f"<!-- results: {name} -->\n<!-- end of results -->\n" for name in ("plan", "predict"))
    (docs / "benchmarks.md").write_text(marks, encoding="utf-8")
    assert make(docs=docs).exit_code == 0
    text = (docs / "benchmarks.md").read_text(encoding="utf-8")
    assert "| first path, ms |" in text and "| encode |" in text and text.count("Machine: ") == 2


def test_adding_checks_what_it_stores(tmp_path):
    file = written(tmp_path, two_planners(), "New Result.json")
    run = make("add", file, docs=tmp_path)
    assert run.exit_code == 2 and "name 'New Result'" in run.stderr and "--name" in run.stderr
    run = make("add", file, "--name", "new", docs=tmp_path)
    assert run.exit_code == 0 and "new.json.gz" in run.stdout
    assert load(tmp_path / "results" / "new.json.gz").head.title == "A suite"
    run = make("--check", "add", file, docs=tmp_path)
    assert run.exit_code == 2 and "without a command" in run.stderr


def test_help_teaches():
    run = make("--help")
    assert run.exit_code == 0 and all(name in run.stdout for name in VIEWS)
    for words in ("add paper.json", "--check", "figure:NAME", "facts", "end of results", "Exit codes"):
        assert words in run.stdout
    assert "lrrt_bench" in make("add", "--help").stdout


def test_errors_are_of_the_reports_kind(tmp_path):
    with pytest.raises(ResultError, match="expected one of first-path"):
        table_of(loaded(tmp_path, two_planners()), "nothing")
