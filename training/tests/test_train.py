# SPDX-License-Identifier: BSD-3-Clause
"""Whole runs: stages, and interruptions at any moment that leave no trace in the result."""

from __future__ import annotations

from pathlib import Path

import pytest
import torch
from helpers import tiny_config

from lrrt_training import train as train_file
from lrrt_training.train import LogLine, TimedCheckpoint, load_module, train


def contents(path: Path) -> dict:
    return torch.load(path, weights_only=True)


def weights(path: Path) -> dict[str, torch.Tensor]:
    return contents(path)["state_dict"]


def differing(one: dict[str, torch.Tensor], other: dict[str, torch.Tensor]) -> list[str]:
    assert one.keys() == other.keys()
    return [name for name in one if not torch.equal(one[name], other[name])]


def stop_after(monkeypatch, steps: int, error: BaseException) -> None:
    """Raises the error once the process has made so many steps."""

    class Stopping(LogLine):
        made = 0

        def on_train_batch_end(self, trainer, module, *rest):
            super().on_train_batch_end(trainer, module, *rest)
            Stopping.made += 1
            if Stopping.made == steps:
                raise error

    monkeypatch.setattr(train_file, "LogLine", Stopping)


def test_run_leaves_a_checkpoint_for_each_stage(trained):
    assert {p.name for p in trained.iterdir()} == {"stage1.ckpt", "stage1.done", "stage2.ckpt", "stage2.done", "log"}
    assert contents(trained / "stage1.ckpt")["stage"]["samples"] == 24
    assert contents(trained / "stage2.ckpt")["stage"]["samples"] == 16
    assert contents(trained / "stage2.ckpt")["global_step"] == 4
    assert differing(weights(trained / "stage1.ckpt"), weights(trained / "stage2.ckpt"))


def test_checkpoint_opens_as_a_module(trained):
    module = load_module(trained / "stage2.ckpt")
    assert (module.hparams.width, module.hparams.classes, module.hparams.aspp) == (4, 3, True)
    assert differing(module.state_dict(), weights(trained / "stage2.ckpt")) == []
    assert len(module.hparams.class_weights) == 3
    assert module.hparams.class_weights[2] > module.hparams.class_weights[1], "the path is the rarest class"


@pytest.mark.parametrize("kind", ["Ctrl-C", "crash"])
def test_interrupted_run_ends_with_the_same_weights(trained, store, tmp_path, monkeypatch, keep_sigint, kind):
    """Stopped in the first stage and again in the second; another process makes the samples, too."""
    error = KeyboardInterrupt() if kind == "Ctrl-C" else RuntimeError("power cut")
    config = tiny_config(tmp_path, store.folder, workers=0, save_every=1e9 if kind == "Ctrl-C" else 0.0)
    folder = tmp_path / "tiny"
    stop_after(monkeypatch, 2, error)
    with pytest.raises(type(error)):
        train(config)
    assert contents(folder / "stage1.ckpt")["stage"]["samples"] == 8
    assert not (folder / "stage1.done").exists()
    stop_after(monkeypatch, 7, error)
    with pytest.raises(type(error)):
        train(config)
    assert (folder / "stage1.done").exists()
    assert contents(folder / "stage2.ckpt")["stage"]["samples"] == 12
    monkeypatch.undo()
    assert train(config) == folder / "stage2.ckpt"
    for stage in ("stage1.ckpt", "stage2.ckpt"):
        assert differing(weights(folder / stage), weights(trained / stage)) == []


def test_ctrl_c_tells_how_to_go_on(store, tmp_path, monkeypatch, keep_sigint):
    stop_after(monkeypatch, 1, KeyboardInterrupt())
    with pytest.raises(
        KeyboardInterrupt, match=r"stage 1 was interrupted; the same command goes on from .*stage1\.ckpt"
    ):
        train(tiny_config(tmp_path, store.folder))


def test_second_stage_starts_from_the_first(trained, store, tmp_path, monkeypatch):
    """Also when the first was made by an earlier process."""
    folder = tmp_path / "tiny"
    folder.mkdir()
    for name in ("stage1.ckpt", "stage1.done"):
        (folder / name).write_bytes((trained / name).read_bytes())
    seen = {}

    class Looking(LogLine):
        def on_train_start(self, trainer, module):
            super().on_train_start(trainer, module)
            seen.update({name: value.clone() for name, value in module.network.state_dict().items()})

    monkeypatch.setattr(train_file, "LogLine", Looking)
    train(tiny_config(tmp_path, store.folder))
    first = weights(trained / "stage1.ckpt")
    assert differing(seen, {name: first[f"network.{name}"] for name in seen}) == []
    assert differing(weights(folder / "stage2.ckpt"), weights(trained / "stage2.ckpt")) == []


def test_finished_run_is_not_touched(trained, store, monkeypatch):
    before = {p.name: p.stat().st_mtime_ns for p in trained.iterdir()}
    monkeypatch.setattr(train_file, "run_stage", lambda *_: pytest.fail("a stage ran again"))
    assert train(tiny_config(trained.parent, store.folder)) == trained / "stage2.ckpt"
    assert {p.name: p.stat().st_mtime_ns for p in trained.iterdir()} == before


class FakeTrainer:
    """Writes a checkpoint, or dies half way."""

    is_global_zero = True

    def __init__(self, dies: bool) -> None:
        self.dies = dies

    def save_checkpoint(self, path: Path, weights_only: bool) -> None:
        assert not weights_only, "the optimiser's state belongs to it"
        path.write_text("new"[: 1 if self.dies else 3])
        if self.dies:
            raise OSError("no space left on device")


def test_half_written_checkpoint_never_replaces_the_last_one(tmp_path):
    path = tmp_path / "stage1.ckpt"
    path.write_text("old")
    callback = TimedCheckpoint(path, 0)
    with pytest.raises(OSError, match="no space"):
        callback.save(FakeTrainer(dies=True))
    assert path.read_text() == "old"
    callback.save(FakeTrainer(dies=False))
    assert path.read_text() == "new"
    assert [p.name for p in tmp_path.iterdir()] == ["stage1.ckpt"]


def test_progress_line_gives_the_speed_of_this_process(capsys):
    class Trainer:
        is_global_zero = True

        def __init__(self):
            self.callback_metrics = {"loss": torch.tensor(0.25)}

    class Module:
        samples_seen, progress = 10**9, 0.5

    line = LogLine("run stage 1/1", seconds=0.0)
    line.on_train_start(Trainer(), Module())
    line.on_train_batch_end(Trainer(), Module())
    text = capsys.readouterr().out
    assert text.startswith("run stage 1/1  50.0 %  samples 1,000,000,000     0.0/s  loss 0.2500")
