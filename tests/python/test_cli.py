# SPDX-License-Identifier: BSD-3-Clause
from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from typer.testing import CliRunner

from lrrt import cli

DATA = Path(__file__).parents[1] / "data"
RUN = CliRunner()


@pytest.fixture
def picture(tmp_path) -> Path:
    """40×40 pixels with a wall, and a room that cannot be reached."""
    pixels = np.full((40, 40), 255, np.uint8)
    pixels[:30, 20] = 0
    pixels[32:, 30] = pixels[32, 30:] = 0
    Image.fromarray(pixels).save(tmp_path / "map.png")
    return tmp_path / "map.png"


def invoke(*words: object):
    return RUN.invoke(cli.app, [str(w) for w in words])


def test_plan_prints_one_json_object(picture):
    run = invoke("plan", picture, "--start", 5, 5, "--goal", 35, 5, "--json")
    assert run.exit_code == 0
    fields = json.loads(run.stdout)
    assert fields["status"] == "solved" and fields["solved"] is True
    assert fields["path"][0] == [5, 5] and fields["path"][-1] == [35, 5]
    assert {"cost", "iterations", "nodes", "draws", "cost_history", "region", "timings"} <= set(fields)


def test_plan_prints_a_table_and_draws(picture, tmp_path):
    run = invoke("plan", picture, "--start", 5, 5, "--goal", 35, 5, "--picture", tmp_path / "out.png")
    assert run.exit_code == 0 and "solved" in run.stdout and "iterations" in run.stdout
    assert Image.open(tmp_path / "out.png").size[0] > 100


def test_a_model_that_fails_is_told(picture):
    query = ("plan", picture, "--start", 5, 5, "--goal", 35, 5, "--json", "--model", DATA / "models/nan.onnx")
    run = invoke(*query)
    assert run.exit_code == 2 and "error: " in run.stderr and "nan.onnx" in run.stderr
    run = invoke(*query, "--on-predict-error", "unguided")
    assert run.exit_code == 0 and "warning: planned without guidance" in run.stderr
    fields = json.loads(run.stdout)
    assert fields["solved"] and fields["region"] is None and "nan.onnx" in fields["predict_error"]


def test_no_path_exits_with_3(picture):
    run = invoke("plan", picture, "--start", 5, 5, "--goal", 37, 37, "--json")
    assert run.exit_code == 3
    fields = json.loads(run.stdout)
    assert fields["status"] == "not_connected" and fields["cost"] is None and fields["path"] == []


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("plan", "missing.png", "--start", 5, 5, "--goal", 6, 6), "missing.png"),
        (("plan", "MAP", "--start", 5, 5, "--goal", 6, 6, "--alpha", 2), "alpha"),
        (("plan", "MAP", "--start", 5, 5, "--goal", 6, 6, "--planner", "KPIECE1"), "RRTstar"),
        (("plan", "MAP", "--start", "nan", 5, "--goal", 6, 6), "start"),
        (("plan", "MAP", "--start", 5, 5, "--goal", 6, 6, "--model", "missing.onnx"), "missing.onnx"),
        (("plan", "MAP", "--start", 5, 5, "--goal", 6, 6, "--picture", "/no/such/folder/x.png"), "folder"),
        (("predict", "MAP", "--start", 20.5, 5, "--goal", 6, 6, "--picture", "x.png"), "start"),
        (("info", "missing.onnx"), "missing.onnx"),
    ],
)
def test_bad_input_exits_with_2_and_one_clear_line(picture, words, message):
    run = invoke(*(picture if word == "MAP" else word for word in words))
    assert run.exit_code == 2
    assert run.stderr.startswith("error:") and message in run.stderr
    assert "Traceback" not in run.stderr


def test_missing_options_exit_with_2(picture):
    assert invoke("plan", picture).exit_code == 2


def test_coordinates_are_metres_and_may_be_negative_or_pixels():
    import lrrt

    m = lrrt.read_map(DATA / "room.yaml")
    rows, columns = np.nonzero(m.cells == 0)
    pixel = (columns[0] + 0.5, rows[0] + 0.5)
    world = m.to_world(pixel)
    for words in (("--start", *world, "--goal", *world), ("--pixels", "--start", *pixel, "--goal", *pixel)):
        fields = json.loads(invoke("plan", DATA / "room.yaml", *words, "--json").stdout)
        np.testing.assert_allclose(fields["path"][0], world, atol=1e-9)


def test_negative_coordinates_are_values(picture):
    fields = json.loads(invoke("plan", picture, "--start", -5, -2.5, "--goal", 6, 6, "--json").stdout)
    assert fields["status"] == "start_outside"


def test_predict_writes_a_picture(picture, tmp_path):
    words = ("predict", picture, "--start", 5, 5, "--goal", 35, 5, "--picture", tmp_path / "region.png")
    fields = json.loads(invoke(*words, "--json").stdout)
    assert isinstance(fields["connected"], bool) and (tmp_path / "region.png").is_file()
    assert invoke(*words).exit_code == 0


def test_info_tells_about_a_model():
    fields = json.loads(invoke("info", DATA / "models" / "green.onnx", "--json").stdout)
    assert fields["name"] == "green" and fields["input_size"] == 16
    assert "promising" in invoke("info").stdout and "128, 192" in invoke("info").stdout


@pytest.mark.parametrize("words", [(), ("plan",), ("predict",), ("info",)])
def test_help_teaches(words):
    run = invoke(*words, "--help")
    assert run.exit_code == 0 and "Usage" in run.stdout
    if words == ("plan",):
        assert "Example" in run.stdout and "--start" in run.stdout


def test_the_installed_command_runs(picture):
    command = Path(sys.executable).with_name("lrrt")
    program = [str(command)] if command.exists() else [sys.executable, "-m", "lrrt"]
    words = ["plan", str(picture), "--start", "5", "5", "--goal", "35", "5", "--json"]
    run = subprocess.run([*program, *words], capture_output=True, text=True, check=True)
    assert json.loads(run.stdout)["solved"] and run.stderr == ""
