# SPDX-License-Identifier: BSD-3-Clause
"""The command line, from help to a scored model."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path

import onnx
import pytest
import typer
from helpers import write_config
from typer.testing import CliRunner

from lrrt_training import cli, export, study
from lrrt_training import train as train_file
from lrrt_training.evaluate import CARD_MARKS

COMMANDS = ("generate", "train", "export", "calibrate", "evaluate")


def call(*arguments: str | Path):
    return CliRunner().invoke(cli.app, [str(a) for a in arguments])


def words(text: str) -> str:
    """Without the frame and the line breaks of an error message."""
    return " ".join(text.replace("│", " ").split())


@pytest.mark.parametrize("command", COMMANDS)
def test_help_of_every_command(command):
    result = call(command, "--help")
    assert result.exit_code == 0
    assert "Usage" in result.output


def test_help_says_what_a_run_is_and_how_to_name_more_options():
    assert "train --config" in words(call("--help").output)
    assert "--trainer.devices 2" in words(call("train", "--help").output)


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


def test_generate_without_ray_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "ray", None)
    result = call("generate", "--data", tmp_path, "--levels", "5", "--ray", "auto")
    assert result.exit_code == 2 and 'pip install "lrrt[sweep]"' in words(result.output)


def test_train_hands_on_every_option(store, tmp_path, monkeypatch):
    seen = []
    monkeypatch.setattr(train_file, "train", lambda arguments: seen.append(arguments) or Path("runs/tiny"))
    config = write_config(tmp_path, store.folder)
    result = call("train", "--config", config, "--trainer.devices", "2", "--name=trial")
    assert (result.exit_code, result.output) == (0, "trained: runs/tiny\n")
    assert seen == [["--config", str(config), "--trainer.devices", "2", "--name=trial"]]


def test_wrong_key_in_a_config_is_named(store, tmp_path):
    config = write_config(tmp_path, store.folder, {"model.widht": 32})
    result = call("train", "--config", config)
    assert result.exit_code == 2
    assert "widht" in result.output


def test_config_that_is_not_there_is_named(tmp_path):
    result = call("train", "--config", tmp_path / "absent.yaml")
    assert result.exit_code == 2
    assert "does not exist" in words(result.output)


def test_interrupted_training_tells_how_to_go_on(store, tmp_path, monkeypatch):
    def stopped(_):
        raise KeyboardInterrupt("interrupted; the same command goes on from runs/tiny")

    monkeypatch.setattr(train_file, "train", stopped)
    result = call("train", "--config", write_config(tmp_path, store.folder))
    assert result.exit_code == 130
    assert "the same command goes on from runs/tiny" in result.output


def test_export_calibrate_then_evaluate(trained, store, tmp_path):
    model, card, sheet = tmp_path / "tiny.onnx", tmp_path / "README.md", tmp_path / "sheet.png"
    card.write_text("\n".join(CARD_MARKS))
    result = call("export", trained, "--output", model, "--training-budget", "ten steps", "--torchscript")
    assert result.exit_code == 0, result.output
    assert {p.name for p in tmp_path.iterdir()} == {"README.md", "tiny.onnx", "tiny.pt"}
    properties = export.properties_of(model)
    assert (properties["name"], properties["input_size"]) == ("tiny", "64"), "the size of the last stage"
    assert (properties["training_budget"], properties["training_config"]) == ("ten steps", "tiny")

    folders = ("--data", store.folder, "--external", tmp_path / "absent")
    result = call("calibrate", model, "--levels", "7,9", "--maps", "2", *folders)
    assert result.exit_code == 0, result.output
    assert f"threshold {export.properties_of(model)['threshold']}" in result.output.splitlines()[-1]

    bad = tmp_path / "failures.png"
    options = ("--levels", "7,9", "--maps", "2", "--no-families", "--threads", "1", "--record", "--sheet", sheet)
    options += ("--failures", bad)
    result = call("evaluate", model, *folders, *options)
    assert result.exit_code == 0, result.output
    assert "tiny.onnx, test maps" in result.output
    scores = json.loads((tmp_path / "manifest.json").read_text())["models"]["tiny.onnx"]["scores"]
    assert [name for name in scores if name.isdecimal()] == ["7", "9"] and list(scores)[-1] == "all"
    assert scores["9"]["count"] == 2
    assert "| 9 | " in card.read_text()
    assert sheet.stat().st_size > 1000 and bad.stat().st_size > 1000
    result = call("evaluate", model, *folders, "--levels", "7", "--raw", "--record")
    assert (result.exit_code, "only the scores of what users get" in words(result.output)) == (2, True)


def test_study_compares_runs(trained, store, tmp_path, monkeypatch):
    monkeypatch.setattr(study, "CALIBRATION_MAPS", 2)
    page, run = tmp_path / "prediction.md", shutil.copytree(trained, tmp_path / "tiny")
    arguments = ("study", run, "--levels", "7,9", "--maps", "3", "--page", page, "--data", store.folder)
    assert "expected the lines" in words(call(*arguments).output)
    page.write_text("# Study\n" + "\n".join(study.MARKS) + "\nend\n")
    result = call(*arguments)
    assert result.exit_code == 0, result.output
    numbers = json.loads(page.with_suffix(".json").read_text())[run.name]
    assert numbers["trained"] == [7, 9] and numbers["threshold"] in study.THRESHOLDS
    row = numbers["scores"]["9"]
    assert row["count"] == 3
    assert f"| 9 | {row['accuracy']:.3f} / {row['redundancy']:.3f} / " in page.read_text()
    assert page.read_text().endswith("\nend\n")
    assert page.with_suffix(".png").stat().st_size > 1000

    def again(*_: object) -> None:
        raise AssertionError("scored twice")

    monkeypatch.setattr(study, "export_onnx", again)
    assert call(*arguments).exit_code == 0, "what is known is kept"


def test_export_to_int8(trained, tmp_path, monkeypatch):
    monkeypatch.setattr(cli, "CALIBRATION_PICTURES", 4)
    result = call("export", trained, "--output", tmp_path / "tiny.onnx", "--int8", "--size", "32")
    assert result.exit_code == 0, result.output
    assert [p.name for p in tmp_path.iterdir()] == ["tiny.onnx"], "the fp32 file was a step on the way"
    assert "QuantizeLinear" in {node.op_type for node in onnx.load(tmp_path / "tiny.onnx").graph.node}
    assert export.properties_of(tmp_path / "tiny.onnx")["input_size"] == "32"


def test_failed_export_to_int8_leaves_nothing(trained, tmp_path, monkeypatch):
    def broken(*_, **__):
        raise RuntimeError("no such operator")

    monkeypatch.setattr(cli, "CALIBRATION_PICTURES", 4)
    monkeypatch.setattr(export, "export_int8", broken)
    result = call("export", trained, "--output", tmp_path / "tiny.onnx", "--int8")
    assert result.exit_code == 1
    assert list(tmp_path.iterdir()) == []


def test_difference_to_pytorch_is_an_error(trained, tmp_path, monkeypatch):
    monkeypatch.setattr(cli, "CALIBRATION_PICTURES", 4)
    monkeypatch.setattr(export, "parity", lambda *_: 0.5)
    result = call("export", trained, "--output", tmp_path / "tiny.onnx")
    assert result.exit_code == 1
    assert "largest difference to PyTorch 5.0e-01" in result.output


def test_export_of_nothing_is_explained(tmp_path):
    result = call("export", tmp_path, "--output", tmp_path / "m.onnx")
    assert result.exit_code == 2
    assert "train first" in words(result.output)


def test_export_of_an_impossible_size_is_explained(trained, tmp_path):
    result = call("export", trained, "--output", tmp_path / "m.onnx", "--size", "100")
    assert result.exit_code == 2
    assert "side 100: expected a multiple of 32" in words(result.output)
    assert list(tmp_path.iterdir()) == []


@pytest.fixture(scope="module")
def model(trained, tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("models") / "tiny.onnx"
    network = train_file.load_network(trained)
    export.export_onnx(network, path, 32, export.metadata("tiny", 32, 3, "", ""))
    return path


@pytest.mark.parametrize("command", ["calibrate", "evaluate"])
def test_what_is_no_model_is_named(tmp_path, command):
    (tmp_path / "m.onnx").write_text("no model")
    result = call(command, tmp_path / "m.onnx", "--data", tmp_path)
    assert result.exit_code == 2
    assert "m.onnx" in words(result.output)
    assert call(command, tmp_path / "absent.onnx").exit_code == 2


def test_evaluate_explains_wrong_values(model, store, tmp_path):
    for arguments, message in (
        (("--split", "tset"), "'tset': expected one of train, evaluation, test"),
        (("--levels", "20"), "'20': expected odd levels"),
        (("--maps", "0"), "--maps"),
        (("--record",), "README.md: expected the lines"),
    ):
        result = call("evaluate", model, "--data", store.folder, "--external", tmp_path, *arguments)
        assert result.exit_code == 2
        assert message in words(result.output)


def test_broken_maps_of_other_sources_are_named(model, store, tmp_path):
    from lrrt_training.families.external import MPD_FILE

    (tmp_path / MPD_FILE).write_text("broken")
    result = call("evaluate", model, "--data", store.folder, "--external", tmp_path, "--levels", "7", "--maps", "1")
    assert result.exit_code == 2
    assert MPD_FILE in result.output.replace("\n", "") or "expected uint8 arrays" in words(result.output)
