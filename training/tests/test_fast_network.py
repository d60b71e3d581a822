# SPDX-License-Identifier: BSD-3-Clause
"""The network that ships: shapes, passes, shared weights."""

from __future__ import annotations

import pytest
import torch

from lrrt_training.fast_network import FastNetwork, Hourglass

SMALL = {"width": 4, "channels": (4, 6, 8)}


def image(size: int, number: int = 1) -> torch.Tensor:
    return torch.randint(0, 256, (number, 3, size, size), dtype=torch.uint8)


def parameters(module: torch.nn.Module) -> int:
    return sum(p.numel() for p in module.parameters())


@pytest.mark.parametrize("shared", [False, True])
@pytest.mark.parametrize("passes", [1, 3])
@pytest.mark.parametrize("size", [32, 64, 160])
def test_one_score_of_every_pixel(size, passes, shared):
    network = FastNetwork(**SMALL, passes=passes, shared=shared).eval()
    with torch.inference_mode():
        scores = network(image(size, 2))
    assert scores.shape == (2, network.classes, size, size) == (2, 1, size, size)
    assert scores.dtype == torch.float32
    assert scores.isfinite().all()


def test_several_pictures_are_independent():
    network, pictures = FastNetwork(**SMALL).eval(), image(32, 3)
    with torch.inference_mode():
        together = network(pictures)
        assert torch.allclose(together[1:2], network(pictures[1:2]), atol=1e-5)


@pytest.mark.parametrize(("depth", "stride"), [(1, 8), (2, 16), (3, 32), (4, 64)])
def test_stride_is_the_smallest_side(depth, stride):
    network = FastNetwork(4, (4,) * depth, passes=1).eval()
    assert network.stride == stride
    with torch.inference_mode():
        for size in (stride, 3 * stride):
            assert network(image(size)).shape[-1] == size
        if depth > 1:
            with pytest.raises(RuntimeError):
                network(image(stride + stride // 2))


@pytest.mark.parametrize("passes", [1, 2, 4])
@pytest.mark.parametrize("shared", [False, True])
def test_coarse_scores_of_all_passes_but_the_last_in_training_alone(passes, shared):
    network = FastNetwork(**SMALL, passes=passes, shared=shared)
    *coarse, fine = network.train().outputs(image(64, 2))
    assert [tuple(c.shape) for c in coarse] == [(2, 1, 8, 8)] * (passes - 1)
    assert fine.shape == (2, 1, 64, 64)
    picture = image(64)
    with torch.inference_mode():
        (only,) = network.eval().outputs(picture)
        assert torch.equal(only, network(picture))


def test_shared_weights_do_not_grow_with_the_passes():
    own = {n: FastNetwork(**SMALL, passes=n) for n in (2, 3, 4)}
    shared = {n: FastNetwork(**SMALL, passes=n, shared=True) for n in (2, 3, 4)}
    assert parameters(shared[2]) == parameters(shared[3]) == parameters(shared[4])
    glass, recall = parameters(Hourglass(SMALL["channels"])), parameters(own[2].recalls[0])
    assert parameters(own[3]) - parameters(own[2]) == glass + recall
    assert parameters(own[4]) - parameters(shared[4]) == 3 * glass + 2 * recall


def test_passes_with_shared_weights_compute_more():
    torch.manual_seed(1)
    two, three = (FastNetwork(**SMALL, passes=n, shared=True).eval() for n in (2, 3))
    three.load_state_dict(two.state_dict())
    picture = image(64)
    with torch.inference_mode():
        assert not torch.allclose(two(picture), three(picture), atol=1e-4)


@pytest.mark.parametrize("shared", [False, True])
@pytest.mark.parametrize("passes", [1, 2, 3])
def test_every_parameter_takes_part(passes, shared):
    """DistributedDataParallel waits for the gradient of every parameter."""
    torch.manual_seed(2)
    network = FastNetwork(**SMALL, passes=passes, shared=shared)
    sum(scores.square().mean() for scores in network.outputs(image(64, 2))).backward()
    idle = [name for name, p in network.named_parameters() if p.grad is None or not p.grad.any()]
    assert idle == []


def test_every_pixel_reaches_every_pixel():
    """Passes through the bottom of the hourglass carry information over the whole map."""
    torch.manual_seed(3)
    network = FastNetwork(8, (8, 8, 8, 8), passes=2).eval()
    picture = image(64).float().requires_grad_()
    network(picture)[0, 0, 0, 0].backward()
    assert picture.grad[0, :, -4:, -4:].abs().max() > 0


def test_bad_settings_are_named():
    with pytest.raises(ValueError, match="passes = 0: expected at least 1"):
        FastNetwork(passes=0)
