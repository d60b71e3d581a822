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


def tree(folder: Path) -> dict[str, bytes]:
    return {str(path): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


def refused_before_planning(monkeypatch, folder: Path, *words: object) -> str:
    """What is said of words that are refused; nothing was planned, predicted or written."""
    monkeypatch.chdir(folder)
    for name in ("plan", "default_predictor", "OnnxPredictor"):
        monkeypatch.setattr(cli, name, lambda *_, **__: pytest.fail("was called"))
    before = tree(folder)
    run = invoke(*words)
    assert run.exit_code == 2 and run.stderr.startswith("error:"), run.output
    assert tree(folder) == before
    return run.stderr


@pytest.mark.parametrize("command", ["plan", "predict"])
@pytest.mark.parametrize("output", ["map.png", "./map.png", "soft.png", "hard.png", "model.svg"])
def test_a_picture_never_overwrites_what_is_read(picture, tmp_path, monkeypatch, command, output):
    (tmp_path / "soft.png").symlink_to("map.png")
    (tmp_path / "hard.png").hardlink_to(picture)
    (tmp_path / "model.svg").write_bytes(b"a model")
    query = (command, "map.png", "--start", 5, 5, "--goal", 35, 5, "--model", "model.svg")
    said = refused_before_planning(monkeypatch, tmp_path, *query, "--picture", output)
    assert "which is read" in said and "another file" in said


def test_a_picture_never_overwrites_that_of_a_map_server_map(picture, tmp_path, monkeypatch):
    (tmp_path / "map.yaml").write_text(
        "image: map.png\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )
    query = ("plan", "map.yaml", "--start", 0.5, 2, "--goal", 3.5, 2)
    assert "map.png" in refused_before_planning(monkeypatch, tmp_path, *query, "--picture", "map.png")


@pytest.mark.parametrize("output", ["", ".", "/", "out", "out.pgf", "out.jpg", ".png", "folder.png", "no/folder/x.png"])
def test_pictures_that_cannot_be_written_are_refused_before_planning(picture, tmp_path, monkeypatch, output):
    (tmp_path / "folder.png").mkdir()
    query = ("plan", "map.png", "--start", 5, 5, "--goal", 35, 5)
    assert ".png, .pdf or .svg" in refused_before_planning(monkeypatch, tmp_path, *query, "--picture", output)


@pytest.mark.parametrize("name", ["out.PNG", "out.pdf", "out.svg"])
def test_pictures_of_every_kind_are_written(picture, tmp_path, name):
    run = invoke("plan", picture, "--start", 5, 5, "--goal", 35, 5, "--picture", tmp_path / name)
    assert run.exit_code == 0 and (tmp_path / name).stat().st_size > 1000


def test_a_picture_with_a_name_that_is_too_long_exits_with_2(picture, tmp_path):
    run = invoke("plan", picture, "--start", 5, 5, "--goal", 6, 6, "--picture", tmp_path / f"{'x' * 256}.png")
    assert run.exit_code == 2 and "cannot be written" in run.stderr


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no /dev/full")
@pytest.mark.parametrize(
    "words", [("plan", "MAP", "--start", 5, 5, "--goal", 6, 6), ("info", "--json"), ("--help",), ("--version",)]
)
def test_a_full_disk_is_told_in_one_line(picture, words):
    command = [sys.executable, "-m", "lrrt", *(str(picture if word == "MAP" else word) for word in words)]
    with Path("/dev/full").open("w") as full:
        run = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True)
    assert run.returncode == 2 and run.stderr.startswith("error: standard output: cannot be written"), run.stderr
    assert len(run.stderr.splitlines()) == 1


def test_a_seed_has_64_bits(picture):
    query = ("plan", picture, "--start", 5, 5, "--goal", 6, 6, "--json", "--seed")
    assert invoke(*query, 2**64 - 1).exit_code == 0
    for seed in (2**64, -1):
        run = invoke(*query, seed)
        assert run.exit_code == 2 and "--seed" in run.stderr and "Traceback" not in run.stderr


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
