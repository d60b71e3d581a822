# SPDX-License-Identifier: BSD-3-Clause
"""The Lightning module: targets, probabilities, the loss of coarse passes, class weights, learning at all."""

from __future__ import annotations

from types import SimpleNamespace

import lightning
import pytest
import torch
from torch import nn
from torch.nn import functional

from lrrt_training.data import Curriculum, RegionData, SceneDataset, Stage
from lrrt_training.fast_network import FastNetwork
from lrrt_training.loss import FocalLoss, balancing_weights
from lrrt_training.module import RegionModule, class_frequencies, probabilities, promising_probability, targets
from lrrt_training.paper_network import PaperNetwork


def network_of(classes: int) -> nn.Module:
    torch.manual_seed(1)
    return FastNetwork(16, (24, 32)) if classes == 1 else PaperNetwork(24, classes, aspp=False)


def attached(module: RegionModule, **trainer) -> SimpleNamespace:
    """A module at a trainer that knows what it is told; keep it, the module holds it weakly."""

    class Trainer(SimpleNamespace):
        pass

    stub = Trainer(**trainer)
    module.trainer = stub
    return stub


def test_targets_of_every_number_of_classes():
    label = torch.tensor([[0, 1, 2]], dtype=torch.uint8)
    assert targets(label, 3).tolist() == [[0, 1, 2]]
    assert targets(label, 2).tolist() == targets(label, 1).tolist() == [[0, 0, 1]]
    assert {targets(label, k).dtype for k in (1, 2, 3)} == {torch.int64}


def test_probabilities_of_every_number_of_classes():
    scores = torch.tensor([0.0, 1.0, 2.0]).reshape(1, 3, 1, 1)
    three, two, one = (probabilities(scores[:, 3 - k :]) for k in (3, 2, 1))
    assert three.flatten().tolist() == pytest.approx([0.09003, 0.24473, 0.66524], abs=1e-4)
    assert two.flatten().tolist() == pytest.approx([0.26894, 0.73106], abs=1e-4)
    assert one.flatten().tolist() == pytest.approx([0.88080], abs=1e-4)
    both = torch.cat((torch.zeros(1, 1, 1, 1), scores[:, 2:]), dim=1)
    assert float(probabilities(both)[0, 1]) == pytest.approx(float(one)), "one score is that of two with a zero"


@pytest.mark.parametrize("classes", [1, 2, 3])
def test_promising_is_the_last_class(classes):
    scores = torch.randn(2, classes, 4, 5)
    found = promising_probability(scores)
    assert found.shape == (2, 4, 5)
    assert torch.equal(found, probabilities(scores)[:, -1])
    assert promising_probability(scores.bfloat16()).dtype == torch.float32


@pytest.mark.parametrize("classes", [1, 2, 3])
@pytest.mark.parametrize("balance", [0.0, 0.5, 1.0])
def test_class_weights_from_frequencies(classes, balance):
    frequencies = [0.5, 0.4, 0.1]
    told_apart = frequencies if classes == 3 else [0.9, 0.1]
    assert class_frequencies(frequencies, classes) == pytest.approx(told_apart)
    module = RegionModule(network_of(classes), balance=balance)
    trainer = attached(module, datamodule=SimpleNamespace(class_frequencies=lambda: frequencies))
    assert trainer and module.loss.weights.tolist() == [1.0] * len(told_apart)
    module.on_fit_start()
    wanted = [w**balance for w in balancing_weights(told_apart)]
    assert module.loss.weights.tolist() == pytest.approx(wanted)
    assert "loss.weights" in module.state_dict()


def test_coarse_target_is_promising_where_any_pixel_is():
    label = torch.tensor([[0, 0, 1, 1], [0, 2, 1, 0], [2, 2, 0, 1], [2, 2, 1, 1]], dtype=torch.uint8)[None]
    scores, wanted = torch.randn(1, 1, 2, 2), torch.tensor([[[1, 0], [1, 0]]])
    module = RegionModule(network_of(1), gamma=0.0)
    assert float(module._coarse_loss(scores, label)) == pytest.approx(
        float(functional.binary_cross_entropy_with_logits(scores[:, 0], wanted.float()))
    )


class Passes(nn.Module):
    """Gives what it is told."""

    classes = 1

    def __init__(self, *scores: torch.Tensor) -> None:
        super().__init__()
        self.scores = nn.ParameterList(scores)

    def outputs(self, image: torch.Tensor) -> list[torch.Tensor]:
        return list(self.scores)


@pytest.mark.parametrize("coarse", [0, 1, 3])
def test_coarse_passes_count_with_their_mean(coarse):
    label = torch.randint(0, 3, (2, 16, 16), dtype=torch.uint8)
    fine, few = torch.randn(2, 1, 16, 16), [torch.randn(2, 1, 2, 2) for _ in range(coarse)]
    module = RegionModule(Passes(*few, fine), gamma=2.0, coarse_weight=0.3)
    trainer = attached(module, global_step=1)
    module.log = lambda *_, **__: None
    batch = {"image": torch.zeros(2, 3, 16, 16, dtype=torch.uint8), "label": label}
    loss, covered = FocalLoss([1.0, 1.0], 2.0), functional.max_pool2d((label == 2).float()[:, None], 8)[:, 0].long()
    wanted = loss(fine, (label == 2).long())
    if few:
        wanted = wanted + 0.3 * sum(loss(scores, covered) for scores in few) / coarse
    assert trainer and float(module.training_step(batch, 1)) == pytest.approx(float(wanted), rel=1e-5)


def test_all_processes_of_a_step_have_one_learning_rate():
    """Their dropout differs; and after the step the data go on behind the samples of all of them."""
    plan, found = Curriculum([Stage(32, 400, 4, [5])]), []
    for rank in (0, 1, 2):
        module = RegionModule(network_of(1))
        data = SimpleNamespace(curriculum=plan, first=24)
        trainer = attached(module, global_rank=rank, world_size=3, datamodule=data)
        optimizer = SimpleNamespace(param_groups=[{}], step=lambda closure: closure())
        module.optimizers = lambda optimizer=optimizer: optimizer
        own = torch.arange(24 + 4 * rank, 28 + 4 * rank)
        module.on_train_batch_start({"index": own}, 0)
        drawn = float(torch.rand(1))
        module.optimizer_step(0, 0, optimizer, lambda: None)
        found.append((optimizer.param_groups[0]["lr"], trainer.datamodule.first, drawn))
    assert {rate for rate, _, _ in found} == {plan.learning_rate_at(24)}
    assert {first for _, first, _ in found} == {36}
    assert len({drawn for _, _, drawn in found}) == 3


def test_time_goes_on_after_a_restart():
    first = RegionModule(network_of(1))
    first.seconds = 180.0
    checkpoint: dict = {}
    first.on_save_checkpoint(checkpoint)
    second = RegionModule(network_of(1))
    second.on_load_checkpoint(checkpoint)
    assert second.seconds == 180.0


class TwoSamples(SceneDataset):
    """The same two over and over."""

    def scene(self, index: int):
        return super().scene(index % 2)


class ByHeart(RegionData):
    def dataset(self) -> SceneDataset:
        usual = super().dataset()
        return TwoSamples(usual.curriculum, usual.source, usual.seed)


class Record(lightning.Callback):
    def __init__(self) -> None:
        self.losses: list[float] = []
        self.rates: list[float] = []

    def on_train_batch_end(self, trainer, module, outputs, *_):
        self.losses.append(float(outputs["loss"]))
        self.rates.append(module.optimizers().param_groups[0]["lr"])


@pytest.mark.parametrize("classes", [3, 2, 1])
def test_a_small_network_learns_two_samples_by_heart(store, classes):
    steps, rate = {3: 40, 2: 30, 1: 80}[classes], 8e-3
    stage = Stage(32, 2 * steps, 2, [5, 7], learning_rate=rate, pixel_share=0.0)
    data, record = ByHeart([stage], store.folder, store.folder / "absent", workers=0), Record()
    trainer = lightning.Trainer(
        accelerator="cpu",
        devices=1,
        max_epochs=1,
        logger=False,
        callbacks=[record],
        enable_checkpointing=False,
        enable_progress_bar=False,
        enable_model_summary=False,
    )
    module = RegionModule(network_of(classes))
    trainer.fit(module, data)
    assert len(record.losses) == steps
    assert data.first == data.curriculum.samples
    assert record.losses[-1] < record.losses[0] / 5
    assert record.rates == pytest.approx([stage.learning_rate_at(i / steps) for i in range(steps)])
    assert module.seconds > 0
