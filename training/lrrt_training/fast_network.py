# SPDX-License-Identifier: BSD-3-Clause
"""The network that ships: an hourglass that passes over the map several times, made for two CPU cores.

Patches of 4×4 pixels become features at a quarter of the input's side; an hourglass (Newell, Yang, Deng 2016) at an
eighth of it joins near and far, several times over, and sees the map's own features anew before every pass ("recall",
Bansal et al. 2022). A path through a maze hangs on all of the maze, so what counts is how often information crosses the
map, not how fine the features are.
"""

from __future__ import annotations

import torch
from torch import Tensor, nn
from torch.nn import functional

PATCH = 4  #: side of the patches that become one feature, pixels


def _convolution(inputs: int, outputs: int, kernel: int = 3, stride: int = 1, rectified: bool = True) -> nn.Sequential:
    layers: list[nn.Module] = [
        nn.Conv2d(inputs, outputs, kernel, stride, padding=(kernel - 1) // 2, bias=False),
        nn.BatchNorm2d(outputs),
    ]
    return nn.Sequential(*layers, nn.ReLU(inplace=True)) if rectified else nn.Sequential(*layers)


def _doubled(x: Tensor) -> Tensor:
    return functional.interpolate(x, scale_factor=2, mode="nearest")


class ResidualBlock(nn.Module):
    """Two convolutions beside the identity."""

    def __init__(self, channels: int) -> None:
        super().__init__()
        self.first = _convolution(channels, channels)
        self.second = _convolution(channels, channels, rectified=False)

    def forward(self, x: Tensor) -> Tensor:
        return functional.relu(x + self.second(self.first(x)))


class Hourglass(nn.Module):
    """Down to half the side again and again and back up; as deep as ``channels`` is long."""

    def __init__(self, channels: tuple[int, ...]) -> None:
        super().__init__()
        own, *deeper = channels
        self.before = ResidualBlock(own)
        self.deeper = None
        if deeper:
            self.down = _convolution(own, deeper[0], stride=2)
            self.deeper = Hourglass(tuple(deeper))
            self.up = _convolution(deeper[0], own, kernel=1, rectified=False)
            self.after = ResidualBlock(own)

    def forward(self, x: Tensor) -> Tensor:
        x = self.before(x)
        if self.deeper is None:
            return x
        x = functional.relu(x + _doubled(self.up(self.deeper(self.down(x)))))
        return self.after(x)


class FastNetwork(nn.Module):
    """Map picture in, score of every pixel out: one class, the logarithm of the odds that it is promising.

    Args:
        width: channels at a quarter of the input's side.
        channels: of the hourglass, at 1/8, 1/16 … of the input's side.
        passes: how often the hourglass is passed.
        shared: with the same weights in every pass, or with weights of its own for each.
    """

    classes = 1

    def __init__(
        self, width: int = 32, channels: tuple[int, ...] = (48, 96, 128, 160), passes: int = 3, shared: bool = False
    ) -> None:
        super().__init__()
        if passes < 1:
            raise ValueError(f"passes = {passes}: expected at least 1")
        own = channels[0]
        self.passes = passes
        self.patches = nn.Sequential(
            nn.Conv2d(3, width, PATCH, stride=PATCH, bias=False), nn.BatchNorm2d(width), nn.ReLU(inplace=True)
        )
        self.look = _convolution(width, width)
        self.enter = _convolution(width, own, stride=2)
        self.hourglasses = nn.ModuleList(Hourglass(tuple(channels)) for _ in range(1 if shared else passes))
        self.recalls = nn.ModuleList(
            _convolution(2 * own, own, kernel=1) for _ in range(min(1, passes - 1) if shared else passes - 1)
        )
        self.judge = nn.Conv2d(own, 1, kernel_size=1) if passes > 1 else None
        self.leave = _convolution(own, width, kernel=1, rectified=False)
        self.sharpen = ResidualBlock(width)
        self.classifier = nn.Conv2d(width, PATCH * PATCH, kernel_size=1)

    @property
    def stride(self) -> int:
        """The input's side must be a multiple of this."""
        depth = 0
        glass = self.hourglasses[0]
        while glass.deeper is not None:
            depth, glass = depth + 1, glass.deeper
        return 2 * PATCH * 2**depth

    def outputs(self, image: Tensor) -> list[Tensor]:
        """Scores after every pass but the last at an eighth of the side, then those of ``forward``."""
        fine = self.look(self.patches(image.to(torch.float32) / 255))
        seen = self.enter(fine)
        state = seen
        coarse = []
        for number in range(self.passes):
            if number:
                state = self.recalls[(number - 1) % len(self.recalls)](torch.cat((state, seen), dim=1))
            state = self.hourglasses[number % len(self.hourglasses)](state)
            if self.training and self.judge is not None and number + 1 < self.passes:
                coarse.append(self.judge(state))
        fine = self.sharpen(functional.relu(fine + _doubled(self.leave(state))))
        return [*coarse, functional.pixel_shuffle(self.classifier(fine), PATCH)]

    def forward(self, image: Tensor) -> Tensor:
        """(N, 3, S, S) RGB planes in 0..255, S a multiple of ``stride`` → (N, 1, S, S) scores (logits)."""
        return self.outputs(image)[-1]
