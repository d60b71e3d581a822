# SPDX-License-Identifier: BSD-3-Clause
"""The training run: LightningCLI with checkpoints that lose nothing."""

from __future__ import annotations

import contextlib
import os
import pickle
import sys
import time
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import lightning
import torch
import yaml
from jsonargparse import ArgumentParser
from lightning.pytorch.cli import LightningArgumentParser, LightningCLI, SaveConfigCallback
from torch import nn

from .data import RegionData
from .module import RegionModule

CHECKPOINT, CONFIG = "last.ckpt", "config.yaml"


class CheckpointError(ValueError):
    """A checkpoint that is none, or that holds more than data."""


@contextlib.contextmanager
def _data_alone(checkpoint: Path) -> Iterator[None]:
    """Says what is wrong where PyTorch refuses a file; its own words advise to load it without the check."""
    try:
        yield
    except pickle.UnpicklingError:
        raise CheckpointError(
            f"{checkpoint}: refused: expected a checkpoint that holds tensors, numbers and words alone; this file is "
            "broken, or would run code when it is loaded. Delete it if you do not know where it comes from"
        ) from None


class TimedCheckpoint(lightning.Callback):
    """Saves every so many seconds and at the end, under a temporary name that is then renamed: no file is half."""

    def __init__(self, seconds: float) -> None:
        self.seconds = seconds
        self._last = time.monotonic()

    def save(self, trainer: lightning.Trainer) -> None:
        path = Path(trainer.default_root_dir) / CHECKPOINT
        temporary = path.with_suffix(".part")
        trainer.save_checkpoint(temporary, weights_only=False)
        if trainer.is_global_zero:
            os.replace(temporary, path)
        self._last = time.monotonic()

    def on_train_batch_end(self, trainer: lightning.Trainer, *_: Any) -> None:
        # every process must take part in a save, so the first one decides for all of them
        if trainer.strategy.broadcast(time.monotonic() - self._last >= self.seconds):
            self.save(trainer)

    def on_train_end(self, trainer: lightning.Trainer, module: lightning.LightningModule) -> None:
        self.save(trainer)

    def on_exception(self, trainer: lightning.Trainer, _: lightning.LightningModule, exception: BaseException) -> None:
        if isinstance(exception, KeyboardInterrupt):
            self.save(trainer)


class LogLine(lightning.Callback):
    """One line of progress every so many seconds, for terminals and log files alike."""

    def __init__(self, seconds: float = 30.0) -> None:
        self.seconds = seconds
        self._last, self._first = time.monotonic(), 0

    def on_train_start(self, trainer: lightning.Trainer, module: RegionModule) -> None:
        self._last, self._first = time.monotonic(), trainer.datamodule.first  # the speed is that of this process

    def on_train_batch_end(self, trainer: lightning.Trainer, module: RegionModule, *_: Any) -> None:
        now, done = time.monotonic(), trainer.datamodule.first
        if not trainer.is_global_zero or now - self._last < self.seconds:
            return
        speed = (done - self._first) / (now - self._last)
        self._last, self._first = now, done
        curriculum = trainer.datamodule.curriculum
        figures = {k: float(v) for k, v in trainer.callback_metrics.items()}
        stage = f"stage {curriculum.stage_at(done - 1) + 1}/{len(curriculum.stages)}"
        print(
            f"{stage} {100 * done / curriculum.samples:5.1f} %  samples {done:9,d}  {speed:6.1f}/s  "
            f"{module.seconds / 60:6.1f} min  "
            f"loss {figures.get('loss', float('nan')):.4f}  accuracy {figures.get('accuracy', float('nan')):.3f}  "
            f"redundancy {figures.get('redundancy', float('nan')):.3f}",
            flush=True,
        )


class KeepConfig(SaveConfigCallback):
    """Keeps the whole configuration of a run beside its checkpoint; export reads it."""

    def save_config(self, trainer: lightning.Trainer, _: lightning.LightningModule, stage: str) -> None:
        path = Path(trainer.default_root_dir) / CONFIG
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(self.parser.dump(self.config, skip_none=False))


class TrainingCLI(LightningCLI):
    """LightningCLI with the project's options and callbacks."""

    def add_arguments_to_parser(self, parser: LightningArgumentParser) -> None:
        parser.add_argument("--name", type=str, default="unnamed", help="The run's folder is runs/NAME.")
        parser.add_argument("--weights", type=str, default="", help="Checkpoint whose weights a new run starts from.")
        parser.add_argument("--save_every", type=float, default=120.0, help="Seconds between checkpoints.")
        parser.link_arguments("name", "trainer.default_root_dir", compute_fn=lambda name: f"runs/{name}")

    def instantiate_trainer(self, **kwargs: Any) -> lightning.Trainer:
        given = self.config_init.trainer.callbacks or []
        given = given if isinstance(given, list) else [given]
        mine = [TimedCheckpoint(self.config.save_every), LogLine()]
        return super().instantiate_trainer(callbacks=[*given, *mine], **kwargs)


def configured(arguments: list[str]) -> TrainingCLI:
    """Module, data and trainer of a run, by LightningCLI's arguments; nothing is trained yet."""
    return TrainingCLI(
        RegionModule,
        RegionData,
        save_config_callback=KeepConfig,
        save_config_kwargs={"overwrite": True, "save_to_log_dir": False},
        seed_everything_default=1,
        trainer_defaults={
            "precision": "bf16-mixed",
            "max_epochs": 1,
            "gradient_clip_val": 1.0,
            "enable_progress_bar": sys.stdout.isatty(),
            "enable_checkpointing": False,
            "enable_model_summary": False,
            "use_distributed_sampler": False,
            "log_every_n_steps": 20,
        },
        args=arguments,
        run=False,
    )


def train(arguments: list[str]) -> Path:
    """Trains, or goes on from the run's own checkpoint. Takes LightningCLI's arguments. Returns the run's folder.

    Raises:
        FileNotFoundError: there is no checkpoint at ``weights``.
        CheckpointError: a checkpoint holds more than data.
        KeyboardInterrupt: Ctrl-C; the checkpoint was saved before.
    """
    warnings.filterwarnings("ignore", ".*your dataloader is not resumable")  # it is: by the number of the first sample
    cli = configured(arguments)
    folder = Path(cli.trainer.default_root_dir)
    checkpoint = folder / CHECKPOINT if (folder / CHECKPOINT).exists() else None
    if checkpoint is None and cli.config.weights:
        cli.model.network.load_state_dict(_network_weights(Path(cli.config.weights)))
    with _data_alone(folder / CHECKPOINT), contextlib.suppress(SystemExit):  # what Lightning makes of Ctrl-C
        cli.trainer.fit(cli.model, cli.datamodule, ckpt_path=checkpoint, weights_only=True)
    if cli.trainer.interrupted:
        raise KeyboardInterrupt(f"interrupted; the same command goes on from {folder}")
    return folder


def _configuration(run: Path) -> dict[str, Any]:
    """What a run was configured with.

    Raises:
        FileNotFoundError: the folder holds no run.
    """
    for name in (CONFIG, CHECKPOINT):
        if not (run / name).exists():
            raise FileNotFoundError(f"{run / name}: not there; train first, then name the folder of the run")
    configuration: dict[str, Any] = yaml.safe_load((run / CONFIG).read_text())
    return configuration


def _network_weights(checkpoint: Path) -> dict[str, torch.Tensor]:
    if not checkpoint.exists():
        raise FileNotFoundError(f"{checkpoint}: no checkpoint there; train the run that it belongs to first")
    with _data_alone(checkpoint):
        state = torch.load(checkpoint, weights_only=True, map_location="cpu")["state_dict"]
    return {k.removeprefix("network."): v for k, v in state.items() if k.startswith("network.")}


def load_network(run: Path) -> nn.Module:
    """The network of a run with its last weights, on the CPU, ready to predict."""
    parser = ArgumentParser()
    parser.add_argument("--network", type=nn.Module)
    chosen = parser.parse_object({"network": _configuration(run)["model"]["network"]})
    network: nn.Module = parser.instantiate_classes(chosen).network
    network.load_state_dict(_network_weights(run / CHECKPOINT))
    return network.eval()


def load_data(run: Path) -> RegionData:
    """The training data of a run."""
    parser = ArgumentParser()
    parser.add_class_arguments(RegionData, "data")
    data: RegionData = parser.instantiate_classes(parser.parse_object({"data": _configuration(run)["data"]})).data
    return data
