# SPDX-License-Identifier: BSD-3-Clause
"""What several tests need: a search of their own, lively networks, a short training run."""

from __future__ import annotations

from collections import deque
from pathlib import Path
from typing import Any

import numpy as np
import torch
import yaml
from torch import nn

from lrrt_training.fast_network import FastNetwork
from lrrt_training.paper_network import PaperNetwork

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


def lively(network: nn.Module, size: int = 64) -> nn.Module:
    """An untrained network with probabilities that vary widely and batch norms that have seen data, in eval mode."""
    torch.manual_seed(3)
    nn.init.normal_(network.classifier.weight, std=1.0)
    images = torch.randint(0, 256, (4, 3, size, size), dtype=torch.uint8)
    with torch.no_grad():
        for _ in range(10):
            network.train()(images)
    return network.eval()


def lively_network(classes: int, size: int = 64) -> nn.Module:
    """A small network with so many classes: the one that ships, or the paper's."""
    torch.manual_seed(4)
    network = FastNetwork(8, (8, 12, 16), passes=2) if classes == 1 else PaperNetwork(8, classes)
    return lively(network, size)


def settings(data: Path, **changes: Any) -> dict[str, Any]:
    """A run of two stages of six and four steps, in full precision on one CPU. ``changes``: "data.workers" → value."""
    made: dict[str, Any] = {
        "name": "tiny",
        "save_every": 1e9,
        "model": {
            "network": {
                "class_path": "lrrt_training.paper_network.PaperNetwork",
                "init_args": {"width": 4, "classes": 3},
            }
        },
        "data": {
            "stages": [
                {"size": 32, "samples": 24, "batch_size": 4, "levels": [5, 7]},
                {"size": 64, "samples": 18, "batch_size": 4, "levels": [7, 9], "family_share": 0.25},
            ],
            "folder": str(data),
            "external": str(data / "absent"),
            "workers": 0,
        },
        "trainer": {"accelerator": "cpu", "devices": 1, "precision": "32-true"},
    }
    for key, value in changes.items():
        *outer, last = key.split(".")
        place = made
        for part in outer:
            place = place[part]
        place[last] = value
    return made


def write_config(folder: Path, data: Path, changes: dict[str, Any] | None = None) -> Path:
    """The YAML file of a short run."""
    path = folder / "tiny.yaml"
    path.write_text(yaml.safe_dump(settings(data, **(changes or {}))))
    return path
