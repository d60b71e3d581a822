# SPDX-License-Identifier: BSD-3-Clause
"""The guide docs/guides/train.md, command by command, with fewer samples and maps."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import yaml
from typer.testing import CliRunner

import lrrt
from lrrt_training import cli

ROOT = Path(__file__).parents[2]
FIRST = ROOT / "training" / "configs" / "first.yaml"
SAMPLES = 128  # two batches


def commands() -> list[list[str]]:
    """What the guide has to be typed of the training's own commands."""
    page = (ROOT / "docs" / "guides" / "train.md").read_text(encoding="utf-8")
    return [shlex.split(line) for line in re.findall(r"^lt (.+)$", page, re.MULTILINE)]


def test_guide_leads_to_a_model(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    config = yaml.safe_load(FIRST.read_text())
    for stage in config["data"]["stages"]:
        stage["samples"] = SAMPLES
    config["trainer"]["precision"] = "32-true"
    config["data"]["workers"] = 0
    (tmp_path / "configs").mkdir()
    (tmp_path / "configs" / FIRST.name).write_text(yaml.safe_dump(config))

    steps = commands()
    assert [words[0] for words in steps] == ["generate", "train", "export", "calibrate", "evaluate"]
    for words in steps:
        few = ["--maps", "2"] if "--maps" in words else []  # the last one counts
        result = CliRunner().invoke(cli.app, [*words, *few])
        assert result.exit_code == 0, f"{' '.join(words)}\n{result.output}"
    assert lrrt.OnnxPredictor(tmp_path / "first.onnx").info.training_budget == "a minute on one CPU core"
