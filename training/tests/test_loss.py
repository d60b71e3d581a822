# SPDX-License-Identifier: BSD-3-Clause
"""The loss against values worked out by hand."""

from __future__ import annotations

import math

import pytest
import torch
from torch.nn import functional

from lrrt_training.loss import FocalLoss, balancing_weights


def scores_of(*probabilities: tuple[float, ...]) -> torch.Tensor:
    """Scores (1, K, 1, W) whose softmax is the given distribution of every pixel."""
    return torch.tensor(probabilities).log().T[None, :, None, :]


def target_of(*classes: int) -> torch.Tensor:
    return torch.tensor(classes)[None, None, :]


def test_value_by_hand():
    loss = FocalLoss([0.5, 1.0, 4.0])(scores_of((0.7, 0.2, 0.1), (0.3, 0.3, 0.4)), target_of(0, 2))
    first = -0.5 * 0.3**2 * math.log(0.7)
    second = -4.0 * 0.6**2 * math.log(0.4)
    assert float(loss) == pytest.approx((first + second) / 2, rel=1e-5)


def test_other_exponent_by_hand():
    loss = FocalLoss([1.0, 2.0], gamma=0.5)(scores_of((0.25, 0.75)), target_of(1))
    assert float(loss) == pytest.approx(-2.0 * math.sqrt(0.25) * math.log(0.75), rel=1e-5)


def test_without_focus_it_is_weighted_cross_entropy():
    torch.manual_seed(0)
    scores, target = torch.randn(2, 3, 5, 7), torch.randint(0, 3, (2, 5, 7))
    weights = [0.4, 1.3, 5.0]
    expected = functional.cross_entropy(scores, target, torch.tensor(weights), reduction="none").mean()
    assert float(FocalLoss(weights, gamma=0.0)(scores, target)) == pytest.approx(float(expected), rel=1e-5)


def test_easy_pixels_count_less_than_in_cross_entropy():
    scores, target = scores_of((0.9, 0.1), (0.4, 0.6)), target_of(0, 0)
    focal = [float(FocalLoss([1.0, 1.0])(scores[..., i : i + 1], target[..., i : i + 1])) for i in (0, 1)]
    plain = [float(FocalLoss([1.0, 1.0], 0.0)(scores[..., i : i + 1], target[..., i : i + 1])) for i in (0, 1)]
    assert focal[1] / focal[0] == pytest.approx(36 * plain[1] / plain[0], rel=1e-3)


def test_perfect_prediction_costs_nothing():
    target = torch.randint(0, 3, (1, 8, 8))
    sure = 50.0 * functional.one_hot(target, 3).permute(0, 3, 1, 2).float()
    assert float(FocalLoss([1.0, 1.0, 1.0])(sure, target)) < 1e-6
    assert float(FocalLoss([1.0, 1.0, 1.0])(-sure, target)) > 10


@pytest.mark.parametrize("spread", [0.0, 3.0, 100.0])
def test_gradient_raises_the_right_class_and_lowers_the_others(spread):
    torch.manual_seed(1)
    scores = (spread * torch.randn(1, 3, 6, 6)).requires_grad_()
    target = torch.randint(0, 3, (1, 6, 6))
    FocalLoss([0.5, 1.0, 4.0])(scores, target).backward()
    assert scores.grad.isfinite().all()
    right = functional.one_hot(target, 3).permute(0, 3, 1, 2).bool()
    assert (scores.grad[right] <= 0).all()
    assert (scores.grad[~right] >= 0).all()
    assert (scores.grad[right] < 0).any()


def test_half_precision_scores_are_summed_in_full():
    scores, target = torch.randn(1, 3, 64, 64), torch.randint(0, 3, (1, 64, 64))
    loss = FocalLoss([1.0, 1.0, 1.0])
    low = loss(scores.bfloat16(), target)
    assert low.dtype == torch.float32
    assert float(low) == pytest.approx(float(loss(scores, target)), rel=0.01)


def test_balancing_weights_give_every_class_the_same_say():
    frequencies = [0.5, 0.4, 0.1]
    weights = balancing_weights(frequencies)
    shares = [w * f for w, f in zip(weights, frequencies)]
    assert shares == pytest.approx([1 / 3] * 3)
    assert balancing_weights([50, 40, 10]) == pytest.approx(weights), "counts do as well as shares"


@pytest.mark.parametrize("scale", [1.0, 8.0])
def test_a_single_class_without_focus_is_binary_cross_entropy(scale):
    torch.manual_seed(2)
    scores, target = scale * torch.randn(2, 1, 5, 7), torch.randint(0, 2, (2, 5, 7))
    expected = functional.binary_cross_entropy_with_logits(scores[:, 0], target.float())
    assert float(FocalLoss([1.0, 1.0], gamma=0.0)(scores, target)) == pytest.approx(float(expected), rel=1e-5)


@pytest.mark.parametrize("gamma", [0.0, 0.5, 2.0])
def test_a_single_class_by_the_formula(gamma):
    """Also: it is the loss of two classes of which the first one's score is 0."""
    torch.manual_seed(3)
    scores, target, weights = torch.randn(2, 1, 5, 7), torch.randint(0, 2, (2, 5, 7)), [0.6, 4.0]
    terms = []
    for score, kind in zip(scores.flatten().tolist(), target.flatten().tolist()):
        odds = 1 / (1 + math.exp(-score))
        p = odds if kind == 1 else 1 - odds
        terms.append(-weights[kind] * (1 - p) ** gamma * math.log(p))
    loss = FocalLoss(weights, gamma)
    assert float(loss(scores, target)) == pytest.approx(sum(terms) / len(terms), rel=1e-5)
    both = torch.cat((torch.zeros_like(scores), scores), dim=1)
    assert float(loss(scores, target)) == pytest.approx(float(loss(both, target)), rel=1e-5)


def test_a_single_class_survives_extreme_scores():
    scores = torch.tensor([-1e4, -90.0, 0.0, 90.0, 1e4]).reshape(1, 1, 1, 5).requires_grad_()
    for kind in (0, 1):
        loss = FocalLoss([1.0, 1.0])(scores, torch.full((1, 1, 5), kind))
        (gradient,) = torch.autograd.grad(loss, scores)
        assert loss.isfinite() and gradient.isfinite().all()
        assert (gradient >= 0).all() if kind == 0 else (gradient <= 0).all()


def test_missing_class_is_an_error():
    with pytest.raises(ValueError, match=r"\[0.6, 0.4, 0.0\]: expected positive"):
        balancing_weights([0.6, 0.4, 0.0])
