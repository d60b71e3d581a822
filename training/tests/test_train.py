# SPDX-License-Identifier: BSD-3-Clause
"""Whole runs: what they leave behind, and interruptions that leave no trace in the result."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest
import torch
import yaml
from helpers import write_config

from lrrt_training import store as store_file
from lrrt_training import train as train_file
from lrrt_training.data import Curriculum, Stage
from lrrt_training.paper_network import PaperNetwork
from lrrt_training.train import CHECKPOINT, CONFIG, LogLine, TimedCheckpoint, configured, load_data, load_network, train

CONFIGS = Path(__file__).parents[1] / "configs"
SAMPLES = 24 + 18


def contents(run: Path) -> dict:
    return torch.load(run / CHECKPOINT, weights_only=True)


def first(run: Path) -> int:
    """Number of the first sample that is still to come."""
    return contents(run)["RegionData"]["first"]


def weights(run: Path) -> dict[str, torch.Tensor]:
    return contents(run)["state_dict"]


def differing(one: dict[str, torch.Tensor], other: dict[str, torch.Tensor]) -> list[str]:
    assert one.keys() == other.keys()
    return [name for name in one if not torch.equal(one[name], other[name])]


def stop_after(monkeypatch, steps: int, error: BaseException) -> None:
    """Raises the error once this process has made so many steps."""

    class Stopping(LogLine):
        made = 0

        def on_train_batch_end(self, trainer, module, *rest):
            super().on_train_batch_end(trainer, module, *rest)
            Stopping.made += 1
            if Stopping.made == steps:
                raise error

    monkeypatch.setattr(train_file, "LogLine", Stopping)


def test_run_leaves_a_checkpoint_and_its_configuration(trained):
    assert {p.name for p in trained.iterdir()} == {CHECKPOINT, CONFIG, "lightning_logs"}
    assert contents(trained)["global_step"] == 6 + 4
    assert first(trained) == 24 + 16, "what does not fill a step is left out"
    assert contents(trained)["seconds"] > 0
    kept = yaml.safe_load((trained / CONFIG).read_text())
    assert kept["model"]["network"]["init_args"] == {"width": 4, "classes": 3, "aspp": True}
    assert kept["model"]["gamma"] == 2.0, "defaults, too"
    assert [s["size"] for s in kept["data"]["stages"]] == [32, 64]


def test_network_comes_back_from_the_folder_alone(trained, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    network = load_network(trained)
    assert isinstance(network, PaperNetwork)
    assert (network.encoder.channels[0], network.classes, network.training) == (4, 3, False)
    saved = {k.removeprefix("network."): v for k, v in weights(trained).items() if k.startswith("network.")}
    assert differing(network.state_dict(), saved) == []


def test_data_come_back_from_the_folder_alone(trained, store):
    data = load_data(trained)
    assert [stage.samples for stage in data.curriculum.stages] == [24, 18]
    assert data.curriculum.stages[1] == Stage(64, 18, 4, [7, 9], family_share=0.25)
    assert data.folder == store.folder
    assert data.pictures(2).shape == (2, 3, 64, 64)


@pytest.mark.parametrize("missing", [CHECKPOINT, CONFIG])
def test_folder_without_a_run_is_named(trained, tmp_path, missing):
    for name in {CHECKPOINT, CONFIG} - {missing}:
        (tmp_path / name).write_bytes((trained / name).read_bytes())
    for load in (load_network, *([load_data] if missing == CONFIG else [])):
        with pytest.raises(FileNotFoundError, match=rf"{missing}: not there; train first"):
            load(tmp_path)


@pytest.mark.parametrize("kind", ["Ctrl-C", "crash"])
def test_interrupted_run_ends_with_the_same_weights(trained, store, tmp_path, monkeypatch, keep_sigint, kind):
    """Stopped in the first stage and in the second, and with another number of processes that make samples."""
    error = KeyboardInterrupt() if kind == "Ctrl-C" else RuntimeError("power cut")
    config = write_config(tmp_path, store.folder, {"save_every": 1e9 if kind == "Ctrl-C" else 0.0})
    run = tmp_path / "runs" / "tiny"
    monkeypatch.chdir(tmp_path)
    for steps, done, workers in ((2, 8, 0), (7, 24 + 12, 2)):
        with monkeypatch.context() as patch:
            stop_after(patch, steps, error)
            with pytest.raises(type(error)):
                train(["--config", str(config), "--data.workers", str(workers)])
        assert first(run) == done
    assert run.samefile(train(["--config", str(config)]))
    assert first(run) == first(trained)
    assert contents(run)["global_step"] == contents(trained)["global_step"]
    assert differing(weights(run), weights(trained)) == []


@pytest.mark.parametrize("steps", [6, 10])
def test_interruption_at_the_end_of_a_stage(trained, store, tmp_path, monkeypatch, keep_sigint, steps):
    """Between two stages, and after the last step."""
    config = write_config(tmp_path, store.folder, {"save_every": 0.0})
    monkeypatch.chdir(tmp_path)
    with monkeypatch.context() as patch:
        stop_after(patch, steps, RuntimeError("power cut"))
        with pytest.raises(RuntimeError, match="power cut"):
            train(["--config", str(config)])
    assert differing(weights(train(["--config", str(config)])), weights(trained)) == []


def test_crash_goes_back_to_the_last_checkpoint(trained, store, tmp_path, monkeypatch):
    """The steps after it are made once more."""
    config = write_config(tmp_path, store.folder)
    monkeypatch.chdir(tmp_path)

    class EveryThird(TimedCheckpoint):
        def on_train_batch_end(self, trainer, *_):
            if trainer.global_step % 3 == 0:
                self.save(trainer)

    with monkeypatch.context() as patch:
        patch.setattr(train_file, "TimedCheckpoint", EveryThird)
        stop_after(patch, 8, RuntimeError("power cut"))
        with pytest.raises(RuntimeError, match="power cut"):
            train(["--config", str(config)])
    run = tmp_path / "runs" / "tiny"
    assert first(run) == 24
    assert differing(weights(train(["--config", str(config)])), weights(trained)) == []


def test_ctrl_c_tells_how_to_go_on(store, tmp_path, monkeypatch, keep_sigint):
    monkeypatch.chdir(tmp_path)
    stop_after(monkeypatch, 1, KeyboardInterrupt())
    with pytest.raises(KeyboardInterrupt, match=r"interrupted; the same command goes on from runs/tiny"):
        train(["--config", str(write_config(tmp_path, store.folder))])


def test_finished_run_keeps_its_weights(trained, store, tmp_path, monkeypatch):
    run = tmp_path / "runs" / "tiny"
    run.mkdir(parents=True)
    (run / CHECKPOINT).write_bytes((trained / CHECKPOINT).read_bytes())
    monkeypatch.chdir(tmp_path)
    stop_after(monkeypatch, 1, AssertionError("a step was made"))
    train(["--config", str(write_config(tmp_path, store.folder))])
    assert differing(weights(run), weights(trained)) == []
    assert first(run) == first(trained)


class FakeTrainer:
    """Writes a checkpoint, or dies half way."""

    is_global_zero = True

    def __init__(self, folder: Path, dies: bool) -> None:
        self.default_root_dir, self.dies = str(folder), dies

    def save_checkpoint(self, path: Path, weights_only: bool) -> None:
        assert not weights_only, "the optimiser's state belongs to it"
        path.write_text("new"[: 1 if self.dies else 3])
        if self.dies:
            raise OSError("no space left on device")


def test_half_written_checkpoint_never_replaces_the_last_one(tmp_path):
    path = tmp_path / CHECKPOINT
    path.write_text("old")
    callback = TimedCheckpoint(0)
    with pytest.raises(OSError, match="no space"):
        callback.save(FakeTrainer(tmp_path, dies=True))
    assert path.read_text() == "old"
    callback.save(FakeTrainer(tmp_path, dies=False))
    assert path.read_text() == "new"
    assert [p.name for p in tmp_path.iterdir()] == [CHECKPOINT]


def test_progress_line_gives_the_speed_of_this_process(capsys):
    curriculum = Curriculum([Stage(32, 600, 4, [5]), Stage(64, 400, 4, [7])])
    trainer = SimpleNamespace(
        is_global_zero=True,
        callback_metrics={"loss": torch.tensor(0.25)},
        datamodule=SimpleNamespace(first=700, curriculum=curriculum),
    )
    line = LogLine(seconds=0.0)
    line.on_train_start(trainer, SimpleNamespace(seconds=90.0))
    line.on_train_batch_end(trainer, SimpleNamespace(seconds=90.0))
    text = capsys.readouterr().out
    assert text.startswith("stage 2/2  70.0 %  samples       700     0.0/s     1.5 min  loss 0.2500")


@pytest.mark.parametrize("config", sorted(CONFIGS.glob("*.yaml")), ids=lambda p: p.stem)
def test_shipped_configs_are_complete(config, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    changes = ["--trainer.accelerator", "cpu", "--trainer.devices", "1", "--trainer.precision", "32-true"]
    cli = configured(["--config", str(config), *changes])
    assert Path(cli.trainer.default_root_dir) == Path("runs") / config.stem
    assert cli.trainer.max_epochs == 1
    assert list(tmp_path.iterdir()) == [], "nothing has run"
    for stage in cli.datamodule.curriculum.stages:
        assert isinstance(stage, Stage)
        assert stage.size % cli.model.network.stride == 0
        assert len(stage.levels) > 1, "every batch mixes levels"
        assert stage.samples >= stage.batch_size
        assert stage.family_share + stage.external_share <= 1


def test_a_run_starts_from_the_weights_of_another(trained, store, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    still = {"data.stages": [{"size": 64, "samples": 8, "batch_size": 4, "levels": [7], "learning_rate": 0.0}]}
    config = write_config(tmp_path, store.folder, {**still, "name": "second", "weights": str(trained / CHECKPOINT)})
    start, end = weights(trained), weights(train(["--config", str(config)]))
    learned = [
        name for name in start if name.startswith("network.") and ".running_" not in name and "batches" not in name
    ]
    assert learned and not [name for name in learned if not torch.equal(start[name], end[name])]
    with pytest.raises(FileNotFoundError, match=r"nowhere\.ckpt: no checkpoint there"):
        train(["--config", str(config), "--name", "third", "--weights", "nowhere.ckpt"])


def test_callbacks_of_the_configuration_are_kept(store, tmp_path):
    config = write_config(tmp_path, store.folder, {"trainer.callbacks": {"class_path": "plain_network.KeepTrace"}})
    kinds = [type(callback).__name__ for callback in configured(["--config", str(config)]).trainer.callbacks]
    assert kinds[:4] == ["KeepTrace", "TimedCheckpoint", "LogLine", "KeepConfig"]


@pytest.mark.parametrize(
    "arguments", [["--model.gama", "1"], ["--data.stages", "[{size: 32}]"], ["--trainer.max_epochs", "many"]]
)
def test_wrong_arguments_end_with_two(store, tmp_path, arguments, capsys):
    with pytest.raises(SystemExit) as stop:
        configured(["--config", str(write_config(tmp_path, store.folder)), *arguments])
    assert stop.value.code == 2
    assert arguments[0].removeprefix("--").rpartition(".")[2] in capsys.readouterr().err


def test_two_processes_train_as_one_with_batches_twice_the_size(tmp_path, monkeypatch):
    """Gloo on the CPU. The network has no batch norm, so the mean of both processes' gradients is that of the whole
    batch: their weights are equal bit by bit, and within 1e-4 those of a single process. No sample comes twice."""
    monkeypatch.setitem(store_file.DEFAULT_COUNTS, "train", 6000)  # a process of its own knows nothing of the fixture
    stages = [
        {"size": 16, "samples": 26, "batch_size": 4, "levels": [5], "learning_rate": 0.01},
        {"size": 24, "samples": 18, "batch_size": 2, "levels": [5], "learning_rate": 0.01},
    ]
    changes = {
        "model": {"network": {"class_path": "plain_network.PlainNetwork"}, "gamma": 0.0},
        "data.stages": stages,
        "trainer.callbacks": [{"class_path": "plain_network.KeepTrace"}],
    }
    both, alone = tmp_path / "both", tmp_path / "alone"
    for folder in (both, alone):
        folder.mkdir()
    pair = {"trainer.devices": 2, "trainer.strategy": "ddp", "trainer.use_distributed_sampler": False}
    config = write_config(both, tmp_path / "mazes", {**changes, **pair})
    command = [sys.executable, "-m", "lrrt_training", "train", "--config", str(config)]
    paths = os.pathsep.join(
        [str(Path(__file__).parent), str(Path(__file__).parents[1]), os.environ.get("PYTHONPATH", "")]
    )
    environment = {**os.environ, "PYTHONPATH": paths, "OMP_NUM_THREADS": "1"}
    ran = subprocess.run(command, cwd=both, env=environment, capture_output=True, text=True, timeout=900, check=False)
    assert ran.returncode == 0, ran.stderr
    assert ran.stdout.count("trained: runs/tiny") == 1
    run = both / "runs" / "tiny"
    ranks = [torch.load(run / f"rank{r}.pt", weights_only=True) for r in (0, 1)]
    assert sorted(ranks[0]["seen"] + ranks[1]["seen"]) == [*range(24), *range(26, 26 + 16)], "every sample, once"
    assert first(run) == 26 + 16
    assert ranks[0]["rates"] == ranks[1]["rates"]
    assert differing(ranks[0]["state"], ranks[1]["state"]) == []

    twice = [{**stage, "batch_size": 2 * stage["batch_size"]} for stage in stages]
    monkeypatch.chdir(alone)
    train(["--config", str(write_config(alone, tmp_path / "mazes", {**changes, "data.stages": twice}))])
    single = torch.load(alone / "runs" / "tiny" / "rank0.pt", weights_only=True)
    assert single["rates"] == ranks[0]["rates"]
    apart = {k: float((v - ranks[0]["state"][k]).abs().max()) for k, v in single["state"].items()}
    assert max(apart.values()) < 1e-4, apart
