# SPDX-License-Identifier: BSD-3-Clause
"""What is trained: a network, its loss and its learning rate, as a Lightning module."""

from __future__ import annotations

import math
import time
from typing import Any

import lightning
import torch
from torch import Tensor

from .loss import FocalLoss
from .metrics import accuracy, redundancy
from .network import PaperNetwork, promising_probability

WARM_UP = 0.03  #: share of a stage in which the learning rate rises
OBSTACLE, PROMISING = 1, 2


def learning_rate_factor(progress: float) -> float:
    """Factor of the learning rate at a share of a stage in [0, 1]: a short rise, then half a cosine down to 0."""
    rise = min(1.0, progress / WARM_UP + 0.02)
    return rise * 0.5 * (1.0 + math.cos(math.pi * min(1.0, progress)))


def targets(label: Tensor, classes: int) -> Tensor:
    """Class numbers 0 free, 1 obstacle, 2 promising → targets of a network with 3 or 2 (other, promising) classes."""
    label = label.long()
    return label if classes == 3 else (label == PROMISING).long()


class RegionModule(lightning.LightningModule):
    """One stage of training.

    The stage ends when ``minutes`` have passed or ``samples`` were seen, whichever is given; the learning rate falls
    with the share of it that is over. Both are kept in the checkpoint, so an interrupted stage goes on where it was.

    Args:
        width, classes, aspp: see PaperNetwork.
        class_weights: one weight per class, see loss.balancing_weights.
        learning_rate: highest learning rate of Adam.
        minutes: length of the stage by time; 0 for no limit.
        samples: length of the stage by samples of all processes; 0 for no limit.
    """

    def __init__(
        self,
        width: int,
        classes: int,
        aspp: bool,
        class_weights: list[float],
        learning_rate: float = 1e-3,
        minutes: float = 0.0,
        samples: int = 0,
    ) -> None:
        super().__init__()
        if minutes <= 0 and samples <= 0:
            raise ValueError("a stage needs an end: give minutes or samples")
        self.save_hyperparameters()
        self.network = PaperNetwork(width, classes, aspp).to(memory_format=torch.channels_last)
        self.loss = FocalLoss(class_weights)
        self.seconds_before = 0.0  #: of training in earlier processes
        self.samples_seen = 0
        self._began = time.monotonic()

    @property
    def seconds(self) -> float:
        """Time spent in this stage, over all processes that worked on it one after the other."""
        return self.seconds_before + time.monotonic() - self._began

    @property
    def progress(self) -> float:
        """Share of the stage that is over."""
        shares = [self.seconds / (60 * self.hparams.minutes) if self.hparams.minutes > 0 else 0.0]
        if self.hparams.samples > 0:
            shares.append(self.samples_seen / self.hparams.samples)
        return max(shares)

    def forward(self, image: Tensor) -> Tensor:
        return self.network(image)

    def on_train_start(self) -> None:
        self._began = time.monotonic()

    def on_train_batch_start(self, batch: dict[str, Tensor], batch_idx: int) -> int | None:
        if self.progress >= 1.0:
            self.trainer.should_stop = True
            return -1
        for group in self.optimizers().param_groups:
            group["lr"] = self.hparams.learning_rate * learning_rate_factor(self.progress)
        # dropout hangs on the sample number alone, so that an interrupted stage ends with the same weights
        torch.manual_seed(self.samples_seen + self.global_rank)
        return None

    def training_step(self, batch: dict[str, Tensor], batch_idx: int) -> Tensor:
        image = batch["image"].contiguous(memory_format=torch.channels_last)
        scores = self.network(image)
        loss = self.loss(scores, targets(batch["label"], self.hparams.classes))
        self.samples_seen += len(image) * self.trainer.world_size
        if self.global_step % 20 == 0:
            region = promising_probability(scores.detach()) >= 0.5
            self.log("accuracy", accuracy(region, batch["label"]).mean(), prog_bar=True)
            self.log("redundancy", redundancy(region, batch["label"]).mean(), prog_bar=True)
        self.log("loss", loss.detach(), prog_bar=True)
        self.log("samples", float(self.samples_seen))
        return loss

    def configure_optimizers(self) -> torch.optim.Optimizer:
        return torch.optim.Adam(self.parameters(), lr=self.hparams.learning_rate)

    def on_save_checkpoint(self, checkpoint: dict[str, Any]) -> None:
        checkpoint["stage"] = {"seconds": self.seconds, "samples": self.samples_seen}

    def on_load_checkpoint(self, checkpoint: dict[str, Any]) -> None:
        self.seconds_before = checkpoint["stage"]["seconds"]
        self.samples_seen = checkpoint["stage"]["samples"]
