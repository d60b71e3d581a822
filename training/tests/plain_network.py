# SPDX-License-Identifier: BSD-3-Clause
"""A network and a callback that runs of several processes name in their YAML; its gradients do not mix samples."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import lightning
import torch
from torch import Tensor, nn


class PlainNetwork(nn.Module):
    """Three convolutions without normalisation: the gradient of a batch is the mean of those of its halves."""

    classes, stride = 1, 4

    def __init__(self, width: int = 4) -> None:
        super().__init__()
        self.inside = nn.Sequential(nn.Conv2d(3, width, 4, stride=4), nn.Tanh(), nn.Conv2d(width, width, 3, padding=1))
        self.judge = nn.Conv2d(width, 1, 1)
        self.classifier = nn.Conv2d(width, 16, 1)

    def outputs(self, image: Tensor) -> list[Tensor]:
        features = self.inside(image.float() / 255).tanh()
        fine = nn.functional.pixel_shuffle(self.classifier(features), 4)
        return [self.judge(features), fine] if self.training else [fine]

    def forward(self, image: Tensor) -> Tensor:
        return self.outputs(image)[-1]


class KeepTrace(lightning.Callback):
    """Every process writes down its weights, its learning rates and the samples that it saw."""

    def __init__(self) -> None:
        self.seen: list[int] = []
        self.rates: list[float] = []

    def on_train_batch_end(self, trainer: Any, module: Any, outputs: Any, batch: dict[str, Tensor], *_: Any) -> None:
        self.seen += batch["index"].tolist()
        self.rates.append(trainer.optimizers[0].param_groups[0]["lr"])

    def on_train_end(self, trainer: lightning.Trainer, module: lightning.LightningModule) -> None:
        path = Path(trainer.default_root_dir) / f"rank{trainer.global_rank}.pt"
        state = {name: value.clone() for name, value in module.state_dict().items()}
        torch.save({"seen": self.seen, "rates": self.rates, "state": state}, path)
