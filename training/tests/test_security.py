# SPDX-License-Identifier: BSD-3-Clause
"""Files that want to run code when they are loaded are refused before they do."""

from __future__ import annotations

import pickle
import shutil
from pathlib import Path

import numpy as np
import pytest
import torch
from helpers import write_config
from typer.testing import CliRunner

from lrrt_training import cli
from lrrt_training.families.external import DUNGEON_FILE, ExternalMaps
from lrrt_training.store import MazeStore
from lrrt_training.train import CHECKPOINT, CheckpointError, load_network, train


class Payload:
    """Makes a file when it is unpickled."""

    def __init__(self, trace: Path) -> None:
        self.trace = trace

    def __reduce__(self):
        return Path.touch, (self.trace,)


@pytest.fixture
def trace(tmp_path) -> Path:
    return tmp_path / "the code ran"


def as_archive(payload: Payload, path: Path) -> None:
    torch.save({"state_dict": {"network.weight": torch.zeros(1)}, "more": payload}, path)


def as_bare_pickle(payload: Payload, path: Path) -> None:
    path.write_bytes(pickle.dumps({"state_dict": payload}))


@pytest.fixture(params=[as_archive, as_bare_pickle], ids=["archive", "bare pickle"])
def hostile(request, trace, tmp_path) -> Path:
    """A checkpoint with a payload that works: loaded without care it leaves its trace."""
    path = tmp_path / "hostile" / CHECKPOINT
    path.parent.mkdir()
    request.param(Payload(trace), path)
    if request.param is as_archive:
        torch.load(path, weights_only=False)
    else:
        pickle.loads(path.read_bytes())
    assert trace.exists()
    trace.unlink()
    return path


def test_export_refuses_a_hostile_checkpoint(hostile, trained, trace, tmp_path):
    run = tmp_path / "run"
    shutil.copytree(trained, run)
    shutil.copy(hostile, run / CHECKPOINT)
    with pytest.raises(CheckpointError, match=r"last\.ckpt: refused: expected .* alone"):
        load_network(run)
    result = CliRunner().invoke(cli.app, ["export", str(run), "--output", str(tmp_path / "model.onnx")])
    assert result.exit_code == 2 and "refused" in result.output
    assert not trace.exists() and not (tmp_path / "model.onnx").exists()


@pytest.mark.parametrize("use", ["go on", "weights"])
def test_training_refuses_a_hostile_checkpoint(hostile, store, trace, tmp_path, monkeypatch, use):
    monkeypatch.chdir(tmp_path)
    config = write_config(tmp_path, store.folder, {"weights": str(hostile)} if use == "weights" else None)
    if use == "go on":
        (tmp_path / "runs" / "tiny").mkdir(parents=True)
        shutil.copy(hostile, tmp_path / "runs" / "tiny" / CHECKPOINT)
    with pytest.raises(CheckpointError, match=r"last\.ckpt: refused"):
        train(["--config", str(config)])
    assert not trace.exists()


def test_hostile_arrays_are_not_unpickled(trace, tmp_path):
    store = MazeStore(tmp_path)
    payload = np.array([Payload(trace)], dtype=object)
    path = store.path("train", 21)
    path.parent.mkdir()
    np.savez(path, settings=payload, mazes=payload)
    with pytest.raises(FileNotFoundError, match="no mazes of level 21"):
        store.mazes("train", 21)
    np.savez(tmp_path / DUNGEON_FILE, free_packbits=payload)
    with pytest.raises(ValueError, match="expected"):
        ExternalMaps(tmp_path)
    assert not trace.exists()
