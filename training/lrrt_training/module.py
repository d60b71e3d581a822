# SPDX-License-Identifier: BSD-3-Clause
"""What is trained: a network and its loss, as a Lightning module."""

from __future__ import annotations

import time
from typing import Any

import lightning
import torch
from torch import Tensor, nn
from torch.nn import functional

from .loss import FocalLoss, balancing_weights
from .metrics import OBSTACLE, PROMISING, accuracy, redundancy

LOG_EVERY = 20  #: steps between two looks at accuracy and redundancy


def targets(label: Tensor, classes: int) -> Tensor:
    """Class numbers 0 free, 1 obstacle, 2 promising → those of a network with 3 classes, or 1 or 2 (is promising)."""
    label = label.long()
    return label if classes == 3 else (label == PROMISING).long()


def probabilities(scores: Tensor) -> Tensor:
    """(N, K, S, S) scores → probabilities: softmax over the classes, or the sigmoid of a single one."""
    return scores.sigmoid() if scores.shape[1] == 1 else scores.softmax(dim=1)


def promising_probability(scores: Tensor) -> Tensor:
    """(N, K, S, S) scores → (N, S, S) probability of the promising class, which is the last one."""
    return probabilities(scores.float())[:, -1]


def class_frequencies(frequencies: list[float], classes: int) -> list[float]:
    """Frequencies of free, obstacle and promising pixels → those of the classes that a network tells apart."""
    return frequencies if classes == 3 else [frequencies[0] + frequencies[1], frequencies[2]]


class RegionModule(lightning.LightningModule):
    """A network, its loss, and how far the curriculum of its data has come.

    Args:
        network: has ``classes`` and ``outputs(image)``, the scores of coarse passes (for training) and of the last one.
        gamma: focusing exponent of the loss; 0 for cross entropy.
        balance: exponent of the class weights: 1 cancels the imbalance of the classes, 0 leaves them alike.
        coarse_weight: weight of the coarse passes' mean loss.
        weight_decay: of AdamW; with 0 it is Adam.
    """

    def __init__(
        self,
        network: nn.Module,
        gamma: float = 2.0,
        balance: float = 1.0,
        coarse_weight: float = 0.3,
        weight_decay: float = 0.0,
    ) -> None:
        super().__init__()
        self.network = network.to(memory_format=torch.channels_last)
        self.balance, self.coarse_weight, self.weight_decay = balance, coarse_weight, weight_decay
        self.loss = FocalLoss([1.0] * max(2, self.classes), gamma)
        self.seconds = 0.0  #: of training, over all processes that worked on it one after the other
        self._last = time.monotonic()
        self._next = 0

    @property
    def classes(self) -> int:
        return int(self.network.classes)

    def forward(self, image: Tensor) -> Tensor:
        return self.network(image)

    def on_fit_start(self) -> None:
        if self.balance > 0:
            frequencies = class_frequencies(self.trainer.datamodule.class_frequencies(), self.classes)
            weights = [w**self.balance for w in balancing_weights(frequencies)]
            self.loss.weights.copy_(torch.tensor(weights))

    def on_train_start(self) -> None:
        self._last = time.monotonic()

    def on_train_batch_start(self, batch: dict[str, Tensor], batch_idx: int) -> None:
        own, sample = len(batch["index"]), int(batch["index"][0])
        first = sample - self.trainer.global_rank * own  # of the step of all processes
        self._next = first + self.trainer.world_size * own
        for group in self.optimizers().param_groups:
            group["lr"] = self.trainer.datamodule.curriculum.learning_rate_at(first)  # alike in all processes
        # dropout hangs on the sample number alone, so that an interrupted run ends with the same weights
        torch.manual_seed(sample)

    def optimizer_step(self, *args: Any, **kwargs: Any) -> None:
        super().optimizer_step(*args, **kwargs)
        # at once: callbacks save checkpoints before the module's own on_train_batch_end is called
        self.trainer.datamodule.first = self._next
        self.seconds += time.monotonic() - self._last
        self._last = time.monotonic()

    def training_step(self, batch: dict[str, Tensor], batch_idx: int) -> Tensor:
        image = batch["image"].contiguous(memory_format=torch.channels_last)
        *coarse, scores = self.network.outputs(image)
        target = targets(batch["label"], self.classes)
        loss = self.loss(scores, target)
        if coarse:
            loss = loss + self.coarse_weight * sum(self._coarse_loss(c, batch["label"]) for c in coarse) / len(coarse)
        if self.global_step % LOG_EVERY == 0:
            region = (promising_probability(scores.detach()) >= 0.5) & (batch["label"] != OBSTACLE)
            self.log("accuracy", accuracy(region, batch["label"]).mean(), prog_bar=True)
            self.log("redundancy", redundancy(region, batch["label"]).mean(), prog_bar=True)
        self.log("loss", loss.detach(), prog_bar=True)
        return loss

    def _coarse_loss(self, scores: Tensor, label: Tensor) -> Tensor:
        """A coarse pixel is promising where any pixel that it covers is."""
        promising = (label == PROMISING).float().unsqueeze(1)
        covered = functional.max_pool2d(promising, label.shape[-1] // scores.shape[-1])
        return self.loss(scores, covered.squeeze(1).long())

    def configure_optimizers(self) -> torch.optim.Optimizer:
        return torch.optim.AdamW(self.parameters(), lr=1e-3, weight_decay=self.weight_decay)

    def on_save_checkpoint(self, checkpoint: dict[str, Any]) -> None:
        checkpoint["seconds"] = self.seconds

    def on_load_checkpoint(self, checkpoint: dict[str, Any]) -> None:
        self.seconds = checkpoint["seconds"]
