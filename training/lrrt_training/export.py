# SPDX-License-Identifier: BSD-3-Clause
"""Exports a trained network to ONNX, with the metadata that the library checks, and compares the two."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path

import numpy as np
import onnx
import onnxruntime
import torch
from torch import Tensor, nn

from .data import MARKER_SIDE
from .network import PaperNetwork

OPSET, IR_VERSION = 17, 8  #: what every ONNX Runtime from 1.21 on loads
FORMAT = "1"  #: layout of the metadata
CLASSES = {3: ("free", "obstacle", "promising"), 2: ("other", "promising")}
COLOURS = {
    "start": [255, 0, 0],
    "goal": [0, 0, 255],
    "free": [255, 255, 255],
    "obstacle": [0, 0, 0],
    "promising": [0, 255, 0],
}
TOLERANCE = 1e-4  #: largest difference of a probability between PyTorch and ONNX Runtime


class _WithSoftmax(nn.Module):
    def __init__(self, network: nn.Module) -> None:
        super().__init__()
        self.network = network

    def forward(self, image: Tensor) -> Tensor:
        return self.network(image).softmax(dim=1)


def commit() -> str:
    """The commit of the training code, marked when there are changes on top of it; "unknown" outside a checkout."""
    folder = Path(__file__).parent
    try:
        run = subprocess.run(
            ["git", "describe", "--always", "--abbrev=12", "--dirty", "--exclude=*"],
            cwd=folder,
            capture_output=True,
            text=True,
            check=True,
        )
    except (OSError, subprocess.CalledProcessError):
        return "unknown"
    return run.stdout.strip()


def metadata(name: str, size: int, classes: int, training_data: str, training_budget: str) -> dict[str, str]:
    """What the library reads from the file."""
    return {
        "lrrt_format": FORMAT,
        "name": name,
        "input_size": str(size),
        "marker_side": str(MARKER_SIDE),
        "classes": ",".join(CLASSES[classes]),
        "colours": json.dumps(COLOURS),
        "threshold": "0.5",
        "training_data": training_data,
        "training_budget": training_budget,
        "commit": commit(),
    }


def export_onnx(network: PaperNetwork, path: Path, size: int, properties: dict[str, str]) -> None:
    """Writes the network with softmax and metadata; the file appears only when it is complete."""
    model = _WithSoftmax(network).eval().to(memory_format=torch.contiguous_format)
    temporary = path.with_suffix(".part")
    with torch.inference_mode():
        torch.onnx.export(
            model,
            (torch.zeros(1, 3, size, size, dtype=torch.uint8),),
            str(temporary),
            opset_version=OPSET,
            input_names=["image"],
            output_names=["probability"],
            dynamic_axes={"image": {0: "batch"}, "probability": {0: "batch"}},
            dynamo=False,
        )
    graph = onnx.load(temporary)
    graph.ir_version = IR_VERSION
    onnx.helper.set_model_props(graph, properties)
    onnx.checker.check_model(graph)
    onnx.save(graph, temporary)
    os.replace(temporary, path)


def parity(network: PaperNetwork, path: Path, images: Tensor) -> float:
    """Largest difference of any probability between the network and the file. (N, 3, S, S) uint8 → float."""
    session = onnxruntime.InferenceSession(str(path), providers=["CPUExecutionProvider"])
    (exported,) = session.run(["probability"], {"image": images.numpy()})
    with torch.inference_mode():
        own = _WithSoftmax(network).eval()(images).numpy()
    return float(np.abs(own - exported).max())
