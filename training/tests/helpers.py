# SPDX-License-Identifier: BSD-3-Clause
"""What several tests need: a search of their own, a lively network, a short training run."""

from __future__ import annotations

from collections import deque
from pathlib import Path

import numpy as np
import torch

from lrrt_training.network import PaperNetwork
from lrrt_training.train import Stage, TrainConfig

STEPS = ((-1, 0), (1, 0), (0, -1), (0, 1))

Block = tuple[int, int]


def search(occupied: np.ndarray, start: Block) -> dict[Block, Block]:
    """Breadth-first search over the free blocks: every block that start reaches → the block before it."""
    before = {start: start}
    queue = deque([start])
    while queue:
        row, col = queue.popleft()
        for dr, dc in STEPS:
            block = (row + dr, col + dc)
            inside = 0 <= block[0] < len(occupied) and 0 <= block[1] < len(occupied)
            if inside and not occupied[block] and block not in before:
                before[block] = (row, col)
                queue.append(block)
    return before


def path_of(occupied: np.ndarray, start: Block, goal: Block) -> set[Block]:
    """The blocks of a shortest path."""
    before = search(occupied, start)
    block, blocks = goal, {goal}
    while block != start:
        block = before[block]
        blocks.add(block)
    return blocks


def free_edges(occupied: np.ndarray) -> int:
    """Pairs of free blocks that share a side."""
    free = ~occupied
    return int((free[1:] & free[:-1]).sum() + (free[:, 1:] & free[:, :-1]).sum())


def lively_network(width: int = 8, classes: int = 3, aspp: bool = True, size: int = 64) -> PaperNetwork:
    """An untrained network whose probabilities vary widely and whose batch norms have seen data, in eval mode."""
    torch.manual_seed(3)
    network = PaperNetwork(width, classes, aspp)
    torch.nn.init.normal_(network.classifier.weight, std=1.0)
    images = torch.randint(0, 256, (4, 3, size, size), dtype=torch.uint8)
    with torch.no_grad():
        for _ in range(10):
            network(images)
    return network.eval()


def tiny_config(runs: Path, data: Path, **changes) -> TrainConfig:
    """Two stages of six and four steps, in full precision on one CPU."""
    stages = [
        Stage(size=32, levels=[5, 7], batch_size=4, samples=24),
        Stage(size=64, levels=[7, 9], batch_size=4, samples=16),
    ]
    settings = {
        "name": "tiny",
        "stages": stages,
        "width": 4,
        "data": data,
        "runs": runs,
        "workers": 0,
        "save_every": 1e9,
        "trainer": {"accelerator": "cpu", "devices": 1, "precision": "32-true"},
    }
    return TrainConfig(**{**settings, **changes})
