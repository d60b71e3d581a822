# SPDX-License-Identifier: BSD-3-Clause
"""The network of Liu et al., "Learning-based Fast Path Planning in Complex Environments" (arXiv 2110.10041).

A ResNet18 encoder, atrous spatial pyramid pooling, and a decoder of residual transposed convolutions that takes
in the encoder's features at every resolution. All channel counts scale with one number, ``width`` (64 = paper).
"""

from __future__ import annotations

import torch
from torch import Tensor, nn
from torchvision.models.resnet import BasicBlock, conv1x1
from torchvision.models.segmentation.deeplabv3 import ASPP

STRIDE = 32  #: input pixels per pixel of the deepest feature map
_ASPP_RATES = (1, 2, 4)  #: fitted to the 8×8 feature map of a 256×256 input


def _residual_stage(inputs: int, outputs: int, stride: int) -> nn.Sequential:
    """Two of torchvision's basic residual blocks, as in one layer of ResNet18."""
    shortcut = None
    if stride != 1 or inputs != outputs:
        shortcut = nn.Sequential(conv1x1(inputs, outputs, stride), nn.BatchNorm2d(outputs))
    return nn.Sequential(BasicBlock(inputs, outputs, stride, shortcut), BasicBlock(outputs, outputs))


class ResNet18Encoder(nn.Module):
    """ResNet18 without its classifier and of any width; returns the features of every resolution.

    ``forward`` maps (N, 3, S, S) to [S/2, S/4, S/8, S/16, S/32] feature maps with ``channels`` channels.
    At width 64 its parameters have the names and shapes of ``torchvision.models.resnet18``.
    """

    def __init__(self, width: int = 64) -> None:
        super().__init__()
        self.channels = (width, width, 2 * width, 4 * width, 8 * width)
        self.conv1 = nn.Conv2d(3, width, kernel_size=7, stride=2, padding=3, bias=False)
        self.bn1 = nn.BatchNorm2d(width)
        self.relu = nn.ReLU(inplace=True)
        self.maxpool = nn.MaxPool2d(kernel_size=3, stride=2, padding=1)
        self.layer1 = _residual_stage(width, width, stride=1)
        self.layer2 = _residual_stage(width, 2 * width, stride=2)
        self.layer3 = _residual_stage(2 * width, 4 * width, stride=2)
        self.layer4 = _residual_stage(4 * width, 8 * width, stride=2)

    def forward(self, x: Tensor) -> list[Tensor]:
        stem = self.relu(self.bn1(self.conv1(x)))
        features = [stem, self.layer1(self.maxpool(stem))]
        for layer in (self.layer2, self.layer3, self.layer4):
            features.append(layer(features[-1]))
        return features


class ResidualUpBlock(nn.Module):
    """Doubles the resolution: transposed convolution (kernel 4, stride 2) in leading layer and residual path."""

    def __init__(self, inputs: int, outputs: int) -> None:
        super().__init__()
        self.main = nn.Sequential(
            nn.ConvTranspose2d(inputs, outputs, kernel_size=4, stride=2, padding=1, bias=False),
            nn.BatchNorm2d(outputs),
            nn.ReLU(inplace=True),
            nn.ConvTranspose2d(outputs, outputs, kernel_size=3, stride=1, padding=1, bias=False),
            nn.BatchNorm2d(outputs),
        )
        self.residual = nn.Sequential(
            nn.ConvTranspose2d(inputs, outputs, kernel_size=4, stride=2, padding=1, bias=False),
            nn.BatchNorm2d(outputs),
        )
        self.relu = nn.ReLU(inplace=True)

    def forward(self, x: Tensor) -> Tensor:
        return self.relu(self.main(x) + self.residual(x))


class ResidualKeepBlock(nn.Module):
    """Keeps resolution and channels: two transposed convolutions (kernel 3, stride 1) and the identity."""

    def __init__(self, channels: int) -> None:
        super().__init__()
        self.main = nn.Sequential(
            nn.ConvTranspose2d(channels, channels, kernel_size=3, stride=1, padding=1, bias=False),
            nn.BatchNorm2d(channels),
            nn.ReLU(inplace=True),
            nn.ConvTranspose2d(channels, channels, kernel_size=3, stride=1, padding=1, bias=False),
            nn.BatchNorm2d(channels),
        )
        self.relu = nn.ReLU(inplace=True)

    def forward(self, x: Tensor) -> Tensor:
        return self.relu(self.main(x) + x)


def _up_layer(inputs: int, outputs: int) -> nn.Sequential:
    """An up-sampling layer: two residual decoder blocks in series."""
    return nn.Sequential(ResidualUpBlock(inputs, outputs), ResidualKeepBlock(outputs))


class Decoder(nn.Module):
    """Brings the context (S/32) back to full resolution; the encoder's features of its size join each output."""

    def __init__(self, context: int, skips: tuple[int, ...], outputs: int) -> None:
        super().__init__()
        self.layers = nn.ModuleList()
        inputs = context
        for skip in reversed(skips):
            self.layers.append(_up_layer(inputs, skip))
            inputs = 2 * skip
        self.last = _up_layer(inputs, outputs)

    def forward(self, context: Tensor, skips: list[Tensor]) -> Tensor:
        x = context
        for layer, skip in zip(self.layers, reversed(skips)):
            x = torch.cat((layer(x), skip), dim=1)
        return self.last(x)


class PaperNetwork(nn.Module):
    """Map picture in, class scores of every pixel out.

    Args:
        width: channels of the first layer; 64 is the paper's network.
        classes: 3 (free, obstacle, promising) or 2 (other, promising).
        aspp: with atrous spatial pyramid pooling, or without (the paper's ablation).
    """

    def __init__(self, width: int = 64, classes: int = 3, aspp: bool = True) -> None:
        super().__init__()
        self.classes = classes
        if classes not in (2, 3):
            raise ValueError(f"classes = {classes}: expected 3 (free, obstacle, promising) or 2 (other, promising)")
        if width < 2 or width % 2:
            raise ValueError(f"width = {width}: expected an even number of channels, at least 2")
        self.encoder = ResNet18Encoder(width)
        *skips, deepest = self.encoder.channels
        context = 4 * width if aspp else deepest
        self.context = ASPP(deepest, list(_ASPP_RATES), context) if aspp else nn.Identity()
        self.decoder = Decoder(context, tuple(skips), width // 2)
        self.classifier = nn.Conv2d(width // 2, classes, kernel_size=1)
        self.stride = STRIDE
        self._initialise()

    def _initialise(self) -> None:
        for module in self.modules():
            if isinstance(module, (nn.Conv2d, nn.ConvTranspose2d)):
                nn.init.kaiming_normal_(module.weight, mode="fan_out", nonlinearity="relu")
        nn.init.normal_(self.classifier.weight, std=0.01)
        nn.init.zeros_(self.classifier.bias)

    def outputs(self, image: Tensor) -> list[Tensor]:
        """The scores of ``forward``; this network has no coarse ones."""
        return [self(image)]

    def forward(self, image: Tensor) -> Tensor:
        """(N, 3, S, S) RGB planes in 0..255, S a multiple of 32 → (N, classes, S, S) scores (logits)."""
        *skips, deepest = self.encoder(image.to(torch.float32) / 255)
        return self.classifier(self.decoder(self.context(deepest), skips))
