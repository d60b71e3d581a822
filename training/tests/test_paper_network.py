# SPDX-License-Identifier: BSD-3-Clause
"""The paper's network: shapes of every variant, and the parts that the paper names."""

from __future__ import annotations

import pytest
import torch
from torchvision.models import resnet18

from lrrt_training.paper_network import PaperNetwork, ResidualKeepBlock, ResidualUpBlock, ResNet18Encoder

PAPER_PARAMETERS = 22_886_371


def image(size: int, number: int = 1) -> torch.Tensor:
    return torch.randint(0, 256, (number, 3, size, size), dtype=torch.uint8)


@pytest.mark.parametrize("classes", [3, 2])
@pytest.mark.parametrize("aspp", [True, False])
@pytest.mark.parametrize(("width", "size"), [(8, 64), (8, 128), (16, 128), (8, 256)])
def test_scores_of_every_pixel(width, classes, aspp, size):
    network = PaperNetwork(width, classes, aspp).eval()
    with torch.inference_mode():
        scores = network(image(size))
    assert scores.shape == (1, classes, size, size)
    assert scores.dtype == torch.float32
    assert scores.isfinite().all()


def test_encoder_is_resnet18():
    with torch.device("meta"):
        ours, theirs = ResNet18Encoder(64), resnet18()
    shapes = {name: tuple(p.shape) for name, p in theirs.state_dict().items() if not name.startswith("fc.")}
    assert {name: tuple(p.shape) for name, p in ours.state_dict().items()} == shapes


def test_encoder_computes_what_resnet18_computes():
    theirs = resnet18().eval()
    ours = ResNet18Encoder(64).eval()
    ours.load_state_dict({k: v for k, v in theirs.state_dict().items() if not k.startswith("fc.")})
    picture = torch.rand(1, 3, 64, 64)
    with torch.inference_mode():
        deepest = ours(picture)[-1]
        assert torch.allclose(theirs.fc(deepest.mean(dim=(2, 3))), theirs(picture), atol=1e-5)


def test_encoder_halves_the_resolution_five_times():
    encoder = ResNet18Encoder(8).eval()
    with torch.inference_mode():
        features = encoder(torch.rand(1, 3, 96, 96))
    assert [tuple(f.shape[1:]) for f in features] == [(8, 48, 48), (8, 24, 24), (16, 12, 12), (32, 6, 6), (64, 3, 3)]
    assert encoder.channels == (8, 8, 16, 32, 64)


@pytest.mark.parametrize("side", [2, 5, 8])
def test_blocks_double_or_keep(side):
    features = torch.rand(2, 6, side, side)
    assert ResidualUpBlock(6, 4)(features).shape == (2, 4, 2 * side, 2 * side)
    assert ResidualKeepBlock(6)(features).shape == features.shape


def test_up_block_is_built_as_in_the_paper():
    block = ResidualUpBlock(6, 4)
    for convolution in (block.main[0], block.residual[0]):
        assert isinstance(convolution, torch.nn.ConvTranspose2d)
        assert (convolution.kernel_size, convolution.stride) == ((4, 4), (2, 2))
    keep = ResidualKeepBlock(4)
    for convolution in (block.main[3], keep.main[0], keep.main[3]):
        assert isinstance(convolution, torch.nn.ConvTranspose2d)
        assert (convolution.kernel_size, convolution.stride) == ((3, 3), (1, 1))


def test_blocks_are_residual():
    """With a silent main path the other path alone reaches the output."""
    features = torch.rand(2, 4, 5, 5)
    up, keep = ResidualUpBlock(4, 3), ResidualKeepBlock(4)
    for block in (up, keep):
        torch.nn.init.zeros_(block.main[-1].weight)
    assert torch.equal(keep(features), features)
    assert torch.allclose(up(features), up.residual(features).relu())


def test_parameters_at_the_papers_width():
    with torch.device("meta"):
        network = PaperNetwork(64)
    assert sum(p.numel() for p in network.parameters()) == PAPER_PARAMETERS


def test_every_parameter_takes_part():
    network = PaperNetwork(4)
    network(image(64, 2)).square().sum().backward()
    idle = [name for name, p in network.named_parameters() if p.grad is None or not p.grad.any()]
    assert idle == []


def test_skips_reach_the_output():
    """Features of every resolution go to the decoder: a change of any of them changes the scores."""
    network = PaperNetwork(8).eval()
    torch.nn.init.normal_(network.classifier.weight)
    with torch.inference_mode():
        *skips, deepest = network.encoder(torch.rand(1, 3, 64, 64))
        plain = network.decoder(network.context(deepest), skips)
        for i in range(len(skips)):
            changed = [s + 1.0 if i == j else s for j, s in enumerate(skips)]
            assert not torch.allclose(network.decoder(network.context(deepest), changed), plain, atol=1e-3)


@pytest.mark.parametrize(("settings", "message"), [({"classes": 4}, "classes = 4"), ({"width": 7}, "width = 7")])
def test_bad_settings_are_named(settings, message):
    with pytest.raises(ValueError, match=message):
        PaperNetwork(**settings)


@pytest.mark.parametrize("classes", [2, 3])
def test_what_training_and_export_ask_for(classes):
    """Both networks have classes, stride and outputs; this one has no coarse scores."""
    network = PaperNetwork(4, classes).eval()
    assert (network.classes, network.stride) == (classes, 32)
    picture = image(32)
    with torch.inference_mode():
        (scores,) = network.outputs(picture)
        assert torch.equal(scores, network(picture))
