# SPDX-License-Identifier: BSD-3-Clause
"""The command line, from help to a scored model."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import onnx
import pytest
import typer
from typer.testing import CliRunner

from lrrt_training import cli
from lrrt_training import train as train_file
from lrrt_training.evaluate import CARD_BEGIN, CARD_END

CONFIGS = Path(__file__).parents[1] / "configs"
COMMANDS = ("generate", "train", "export", "evaluate")


def call(*arguments: str | Path):
    return CliRunner().invoke(cli.app, [str(a) for a in arguments])


@pytest.mark.parametrize("command", COMMANDS)
def test_help_of_every_command(command):
    result = call(command, "--help")
    assert result.exit_code == 0
    assert "Usage" in result.output


def test_module_runs_and_lists_its_commands():
    result = subprocess.run(
        [sys.executable, "-m", "lrrt_training", "--help"], capture_output=True, text=True, check=False
    )
    assert result.returncode == 0, result.stderr
    assert all(command in result.stdout for command in COMMANDS)


def test_levels():
    assert cli._levels("21-25,31") == [21, 23, 25, 31]
    for text in ("", "21-", "twenty", "20-30", "21,22", "49-21"):
        with pytest.raises(typer.BadParameter, match=f"'{text}': .*expected (odd )?levels such as"):
            cli._levels(text)


def test_generate_says_what_it_made(tmp_path):
    first = call("generate", "--data", tmp_path, "--levels", "5", "--workers", "1")
    assert (first.exit_code, "3 new files" in first.output) == (0, True)
    assert "0 new files" in call("generate", "--data", tmp_path, "--levels", "5").output


@pytest.mark.parametrize("config", sorted(CONFIGS.glob("*.yaml")), ids=lambda p: p.stem)
def test_shipped_configs_are_complete(config, monkeypatch):
    read = []
    monkeypatch.setattr(train_file, "train", lambda settings: read.append(settings) or "nowhere")
    result = call("train", "--config", config, "--minutes", "3")
    assert result.exit_code == 0, result.output
    (settings,) = read
    assert settings.name == config.stem
    for stage in settings.stages:
        assert isinstance(stage, train_file.Stage)
        assert stage.size % 32 == 0
        assert len(stage.levels) > 1, "every batch mixes levels"
        assert stage.minutes == 3


def test_wrong_key_in_a_config_is_named(tmp_path):
    config = tmp_path / "wrong.yaml"
    config.write_text("name: wrong\nwidht: 32\nstages: []\n")
    result = call("train", "--config", config)
    assert result.exit_code != 0
    assert "widht" in result.output


def test_interrupted_training_tells_how_to_go_on(tmp_path, monkeypatch):
    def stopped(_):
        raise KeyboardInterrupt("stage 2 was interrupted; the same command goes on")

    monkeypatch.setattr(train_file, "train", stopped)
    result = call("train", "--config", CONFIGS / "default.yaml")
    assert result.exit_code == 130
    assert "stage 2 was interrupted; the same command goes on" in result.output


def test_export_then_evaluate(trained, store, tmp_path):
    model, card = tmp_path / "tiny.onnx", tmp_path / "README.md"
    card.write_text(f"{CARD_BEGIN}\n{CARD_END}\n")
    result = call("export", trained, "--output", model, "--size", "64", "--training-budget", "ten steps")
    assert result.exit_code == 0, result.output
    properties = {p.key: p.value for p in onnx.load(model).metadata_props}
    assert (properties["name"], properties["input_size"]) == ("tiny", "64")
    assert properties["training_budget"] == "ten steps"
    sheet = tmp_path / "sheet.png"
    options = (
        "--levels",
        "7,9",
        "--mazes",
        "2",
        "--data",
        store.folder,
        "--threads",
        "1",
        "--record",
        "--sheet",
        sheet,
    )
    result = call("evaluate", model, *options)
    assert result.exit_code == 0, result.output
    assert "tiny.onnx, test mazes" in result.output
    assert json.loads((tmp_path / "manifest.json").read_text())["models"]["tiny.onnx"]["scores"]["9"]["count"] == 2
    assert "| 9 | " in card.read_text()
    assert sheet.stat().st_size > 1000


def test_export_takes_the_last_stage(trained, tmp_path):
    run = tmp_path / "run"
    run.mkdir()
    (run / "stage10.ckpt").write_bytes((trained / "stage2.ckpt").read_bytes())
    (run / "stage9.ckpt").write_text("not the last")
    assert call("export", run, "--output", tmp_path / "m.onnx", "--size", "32").exit_code == 0


def test_export_of_nothing_is_explained(tmp_path):
    result = call("export", tmp_path, "--output", tmp_path / "m.onnx")
    assert result.exit_code == 2
    assert "no checkpoint" in result.output


def test_evaluate_names_an_unknown_split(tmp_path):
    (tmp_path / "m.onnx").touch()
    result = call("evaluate", tmp_path / "m.onnx", "--split", "tset", "--data", tmp_path)
    assert result.exit_code == 2
    assert "'tset': expected one of" in result.output
