# SPDX-License-Identifier: BSD-3-Clause
"""The Lightning module: learning rate, end of a stage, learning at all."""

from __future__ import annotations

import lightning
import numpy as np
import pytest
import torch
from torch.utils.data import DataLoader

from lrrt_training import module as module_file
from lrrt_training.data import MazeDataset
from lrrt_training.module import WARM_UP, RegionModule, learning_rate_factor, targets


def test_learning_rate_rises_shortly_then_falls_to_zero():
    progress = np.linspace(0, 1, 1001)
    factor = np.array([learning_rate_factor(p) for p in progress])
    top = int(factor.argmax())
    assert 0 < factor[0] < 0.05
    assert progress[top] == pytest.approx(WARM_UP, abs=0.005)
    assert factor[top] == pytest.approx(1.0, abs=0.01)
    assert (np.diff(factor[: top + 1]) > 0).all()
    assert (np.diff(factor[top:]) < 0).all()
    assert factor[500] == pytest.approx(0.5, abs=0.01)
    assert factor[-1] == pytest.approx(0.0, abs=1e-12)
    assert learning_rate_factor(1.2) == pytest.approx(0.0, abs=1e-12), "past the end it stays there"


def test_targets_of_two_and_three_classes():
    label = torch.tensor([[0, 1, 2]], dtype=torch.uint8)
    assert targets(label, 3).tolist() == [[0, 1, 2]]
    assert targets(label, 2).tolist() == [[0, 0, 1]]
    assert targets(label, 2).dtype == torch.int64


def test_a_stage_needs_an_end():
    with pytest.raises(ValueError, match="give minutes or samples"):
        RegionModule(4, 3, False, [1.0, 1.0, 1.0])


def test_progress_is_the_share_of_time_or_samples(monkeypatch):
    clock = [100.0]
    monkeypatch.setattr(module_file.time, "monotonic", lambda: clock[0])
    module = RegionModule(4, 3, False, [1.0, 1.0, 1.0], minutes=10, samples=1000)
    module.on_train_start()
    assert module.progress == 0.0
    module.samples_seen = 250
    clock[0] += 60
    assert module.progress == pytest.approx(0.25)
    clock[0] += 240
    assert module.progress == pytest.approx(0.5), "whichever is farther"


def test_time_goes_on_after_a_restart(monkeypatch):
    clock = [0.0]
    monkeypatch.setattr(module_file.time, "monotonic", lambda: clock[0])
    first = RegionModule(4, 3, False, [1.0, 1.0, 1.0], minutes=10)
    first.on_train_start()
    clock[0] = 180.0
    checkpoint: dict = {}
    first.on_save_checkpoint(checkpoint)
    clock[0] = 5000.0
    second = RegionModule(4, 3, False, [1.0, 1.0, 1.0], minutes=10)
    second.on_load_checkpoint(checkpoint)
    clock[0] = 5100.0
    second.on_train_start()
    assert second.seconds == pytest.approx(180), "what lies between is not training time"
    clock[0] += 120
    assert second.progress == pytest.approx(0.5)


class Losses(lightning.Callback):
    def __init__(self) -> None:
        self.losses: list[float] = []
        self.rates: list[float] = []

    def on_train_batch_end(self, trainer, module, outputs, *_):
        self.losses.append(float(outputs["loss"]))
        self.rates.append(module.optimizers().param_groups[0]["lr"])


@pytest.mark.parametrize("classes", [3, 2])
def test_a_small_network_learns_a_few_samples_by_heart(store, classes):
    lightning.seed_everything(1)
    dataset = MazeDataset(store, "train", [5, 7], size=32, length=2, pixel_share=0.0)
    samples = [dataset[i] for i in range(2)]
    steps, rate = {3: 40, 2: 25}[classes], 8e-3
    record = Losses()
    trainer = lightning.Trainer(
        accelerator="cpu",
        devices=1,
        max_epochs=-1,
        logger=False,
        callbacks=[record],
        enable_checkpointing=False,
        enable_progress_bar=False,
        enable_model_summary=False,
    )
    weights = {3: [0.7, 0.6, 4.0], 2: [0.6, 4.0]}[classes]
    module = RegionModule(24, classes, False, weights, learning_rate=rate, samples=2 * steps)
    trainer.fit(module, DataLoader(samples, 2))
    assert len(record.losses) == steps, "the stage ends by its samples"
    assert record.losses[-1] < record.losses[0] / 5
    assert record.rates == pytest.approx([rate * learning_rate_factor(i / steps) for i in range(steps)])
