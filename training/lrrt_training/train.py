# SPDX-License-Identifier: BSD-3-Clause
"""The training run: one stage after the other, each from the weights of the one before, resumable at any moment."""

from __future__ import annotations

import contextlib
import os
import time
import warnings
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import lightning
import torch
from lightning.pytorch.loggers import TensorBoardLogger
from torch.utils.data import DataLoader

from .data import MazeDataset, ResumableSampler, class_frequencies
from .loss import balancing_weights
from .module import RegionModule
from .store import MazeStore

ENDLESS = 10**9  #: batches; a stage ends by its own clock


@dataclass
class Stage:
    """One step of the curriculum."""

    size: int  #: side of the network's input, pixels
    levels: list[int]  #: maze levels; every batch mixes them
    batch_size: int  #: samples a batch of one process
    learning_rate: float = 1e-3
    minutes: float = 0.0  #: length by time; 0: no limit
    samples: int = 0  #: length by samples; 0: no limit
    pixel_share: float = 0.5  #: share of the maps with several pixels a block


@dataclass
class TrainConfig:
    """What a YAML file in configs/ says."""

    name: str
    stages: list[Stage]
    width: int = 64
    classes: int = 3
    aspp: bool = True
    seed: int = 1
    data: Path = Path("data_cache")
    runs: Path = Path("runs")
    workers: int = 1  #: processes that make samples
    save_every: float = 120.0  #: seconds between checkpoints
    #: further arguments of lightning.Trainer (accelerator, devices, precision …)
    trainer: dict[str, Any] = field(default_factory=dict)


class TimedCheckpoint(lightning.Callback):
    """Saves every so many seconds and at the end, under a temporary name that is then renamed: no file is half."""

    def __init__(self, path: Path, seconds: float) -> None:
        self.path, self.seconds = path, seconds
        self._last = time.monotonic()

    def save(self, trainer: lightning.Trainer) -> None:
        temporary = self.path.with_suffix(".part")
        trainer.save_checkpoint(temporary, weights_only=False)
        if trainer.is_global_zero:
            os.replace(temporary, self.path)
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

    def __init__(self, title: str, seconds: float = 30.0) -> None:
        self.title, self.seconds = title, seconds
        self._last, self._samples = time.monotonic(), 0

    def on_train_start(self, trainer: lightning.Trainer, module: RegionModule) -> None:
        self._last, self._samples = time.monotonic(), module.samples_seen  # the speed is that of this process

    def on_train_batch_end(self, trainer: lightning.Trainer, module: RegionModule, *_: Any) -> None:
        now = time.monotonic()
        if not trainer.is_global_zero or now - self._last < self.seconds:
            return
        speed = (module.samples_seen - self._samples) / (now - self._last)
        self._last, self._samples = now, module.samples_seen
        figures = {k: float(v) for k, v in trainer.callback_metrics.items()}
        print(
            f"{self.title} {100 * module.progress:5.1f} %  samples {module.samples_seen:8,d}  {speed:6.1f}/s  "
            f"loss {figures.get('loss', float('nan')):.4f}  accuracy {figures.get('accuracy', float('nan')):.3f}  "
            f"redundancy {figures.get('redundancy', float('nan')):.3f}",
            flush=True,
        )


class MazeData(lightning.LightningDataModule):
    """Endless batches of one stage, beginning with sample number ``first``."""

    def __init__(self, dataset: MazeDataset, batch_size: int, workers: int, first: int) -> None:
        super().__init__()
        self.dataset, self.batch_size, self.workers, self.first = dataset, batch_size, workers, first

    def train_dataloader(self) -> DataLoader:
        rank, processes = self.trainer.global_rank, self.trainer.world_size
        sampler = ResumableSampler(self.first, ENDLESS // self.batch_size, self.batch_size, rank, processes)
        return DataLoader(self.dataset, self.batch_size, sampler=sampler, num_workers=self.workers)


def _weights(dataset: MazeDataset, classes: int) -> list[float]:
    frequencies = class_frequencies(dataset)
    if classes == 2:
        frequencies = [frequencies[0] + frequencies[1], frequencies[2]]
    return [float(w) for w in balancing_weights(frequencies)]


def _begun(path: Path) -> int:
    """Samples that a stage's checkpoint has seen; 0 without one."""
    return int(torch.load(path, weights_only=True, map_location="cpu")["stage"]["samples"]) if path.exists() else 0


def run_stage(config: TrainConfig, number: int, previous: RegionModule | None, folder: Path) -> RegionModule:
    """Trains one stage, or what is left of it. Returns its module."""
    stage = config.stages[number]
    checkpoint = folder / f"stage{number + 1}.ckpt"
    store = MazeStore(config.data)
    dataset = MazeDataset(store, "train", stage.levels, stage.size, ENDLESS, config.seed, stage.pixel_share)
    module = RegionModule(
        config.width,
        config.classes,
        config.aspp,
        _weights(dataset, config.classes),
        stage.learning_rate,
        stage.minutes,
        stage.samples,
    )
    if previous is not None:
        module.network.load_state_dict(previous.network.state_dict())
    title = f"{config.name} stage {number + 1}/{len(config.stages)}"
    settings = {"accelerator": "auto", "devices": "auto", "precision": "bf16-mixed", "enable_progress_bar": False}
    trainer = lightning.Trainer(
        **{**settings, **config.trainer},
        max_epochs=1,
        logger=TensorBoardLogger(folder, name="log", version=f"stage{number + 1}"),
        callbacks=[TimedCheckpoint(checkpoint, config.save_every), LogLine(title)],
        enable_checkpointing=False,
        enable_model_summary=False,
        use_distributed_sampler=False,
        log_every_n_steps=20,
    )
    data = MazeData(dataset, stage.batch_size, config.workers, _begun(checkpoint))
    warnings.filterwarnings("ignore", ".*your dataloader is not resumable")  # it is: by the number of the first sample
    with contextlib.suppress(SystemExit):  # what Lightning makes of Ctrl-C
        trainer.fit(module, data, ckpt_path=checkpoint if checkpoint.exists() else None, weights_only=True)
    if trainer.interrupted:
        raise KeyboardInterrupt(f"stage {number + 1} was interrupted; the same command goes on from {checkpoint}")
    return module


def load_module(path: Path) -> RegionModule:
    """A module from a checkpoint, on the CPU."""
    return RegionModule.load_from_checkpoint(path, map_location="cpu", weights_only=True)


def train(config: TrainConfig) -> Path:
    """Runs every stage that is not done. Returns the checkpoint of the last one."""
    lightning.seed_everything(config.seed, workers=True)
    folder = config.runs / config.name
    folder.mkdir(parents=True, exist_ok=True)
    levels = sorted({level for stage in config.stages for level in stage.levels})
    MazeStore(config.data).generate(levels, ("train",))
    module = None
    for number in range(len(config.stages)):
        done = folder / f"stage{number + 1}.done"
        if done.exists():
            module = load_module(folder / f"stage{number + 1}.ckpt")
            continue
        module = run_stage(config, number, module, folder)
        done.touch()
    return folder / f"stage{len(config.stages)}.ckpt"
