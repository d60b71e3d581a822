# SPDX-License-Identifier: BSD-3-Clause
"""The paper's accuracy, redundancy and metric, and connectivity; per map, then the mean, per maze level."""

from __future__ import annotations

import torch
from torch import Tensor
from torchmetrics import Metric

OBSTACLE, PROMISING = 1, 2  #: class numbers in labels
NAMES = ("accuracy", "redundancy", "metric", "connectivity", "linked")


def accuracy(region: Tensor, label: Tensor) -> Tensor:
    """Share of the true path's pixels that the region holds. (N, H, W) bool and classes → (N,)."""
    truth = label == PROMISING
    return (region & truth).flatten(1).sum(1) / truth.flatten(1).sum(1).clamp(min=1)


def redundancy(region: Tensor, label: Tensor) -> Tensor:
    """Free pixels of the region off the path, by pixels of the path. (N, H, W) bool and classes → (N,)."""
    truth = label == PROMISING
    excess = region & ~truth & (label != OBSTACLE)
    return excess.flatten(1).sum(1) / truth.flatten(1).sum(1).clamp(min=1)


def metric(region: Tensor, label: Tensor) -> Tensor:
    """The paper's metric, (1 − accuracy) + redundancy; lower is better. (N, H, W) bool and classes → (N,)."""
    return 1 - accuracy(region, label) + redundancy(region, label)


class RegionMetrics(Metric):
    """Mean accuracy, redundancy, metric = (1 − accuracy) + redundancy, connectivity, and the share of the maps whose
    region needed a link to join start and goal, for every group and over all.

    A group is a maze level or a family of maps. ``compute`` returns {group: {name: value, "count": n}} with the key
    ``"all"`` for the mean over all maps.
    """

    full_state_update = False
    sums: Tensor

    def __init__(self, groups: list[str]) -> None:
        super().__init__()
        self.groups = list(groups)
        self.add_state("sums", torch.zeros(len(groups), 5, dtype=torch.float64), dist_reduce_fx="sum")

    def update(
        self, region: Tensor, label: Tensor, groups: list[str], connected: list[bool], linked: list[bool] | None = None
    ) -> None:
        """Adds maps: (N, H, W) bool region and label, N names of groups, N times whether start and goal are joined, and
        whether that took a link."""
        rows = torch.stack(
            (
                accuracy(region, label).double(),
                redundancy(region, label).double(),
                torch.tensor(connected, dtype=torch.float64, device=region.device),
                torch.tensor(linked or [False] * len(region), dtype=torch.float64, device=region.device),
                torch.ones(len(region), dtype=torch.float64, device=region.device),
            ),
            dim=1,
        )
        index = torch.tensor([self.groups.index(group) for group in groups], device=rows.device)
        self.sums.index_add_(0, index, rows.to(self.sums.dtype))

    def compute(self) -> dict[str, dict[str, float]]:
        """The means; groups without a map are left out."""
        result = {group: _means(row) for group, row in zip(self.groups, self.sums) if row[4] > 0}
        result["all"] = _means(self.sums.sum(dim=0))
        return result


def _means(row: Tensor) -> dict[str, float]:
    acc, red, con, linked, count = row.tolist()
    n = max(count, 1.0)
    return {
        "accuracy": acc / n,
        "redundancy": red / n,
        "metric": (1 - acc / n) + red / n,
        "connectivity": con / n,
        "linked": linked / n,
        "count": int(count),
    }
