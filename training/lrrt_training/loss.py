# SPDX-License-Identifier: BSD-3-Clause
"""Class-weighted focal loss (section "Loss" of the paper, in the standard focal form)."""

from __future__ import annotations

import torch
from torch import Tensor, nn
from torch.nn import functional


class FocalLoss(nn.Module):
    """Mean over the pixels of −Σ_k w_k g_k (1 − p_k)^γ log p_k, with p the softmax of the scores.

    Args:
        class_weights: K weights w_k, which cancel the imbalance of the classes.
        gamma: focusing exponent; 0 gives weighted cross entropy.
    """

    weights: Tensor

    def __init__(self, class_weights: list[float], gamma: float = 2.0) -> None:
        super().__init__()
        self.gamma = gamma
        self.register_buffer("weights", torch.tensor(class_weights, dtype=torch.float32))

    def forward(self, scores: Tensor, target: Tensor) -> Tensor:
        """Scores (N, K, H, W) and class numbers (N, H, W), int64 → scalar. A single class is promising or not."""
        scores = scores.float()
        if scores.shape[1] == 1:
            signed = torch.where(target.unsqueeze(1) == 1, scores, -scores)
            log_p = functional.logsigmoid(signed).squeeze(1)
        else:
            log_p = functional.log_softmax(scores, dim=1).gather(1, target.unsqueeze(1)).squeeze(1)
        loss = -self.weights[target] * log_p
        return ((1 - log_p.exp()).clamp(min=0) ** self.gamma * loss).mean() if self.gamma > 0 else loss.mean()


def balancing_weights(frequencies: list[float]) -> list[float]:
    """w_k = 1 / (K f_k): every class then carries the same weight in total, and the mean weight of a pixel is 1."""
    if min(frequencies) <= 0:
        raise ValueError(f"class frequencies {frequencies}: expected positive shares; the data lacks a class")
    total = sum(frequencies)
    return [total / (len(frequencies) * f) for f in frequencies]
