# SPDX-License-Identifier: BSD-3-Clause
"""Exports a trained network to ONNX (fp32 and int8) and TorchScript, with the metadata that the library checks, and
compares the files with PyTorch."""

from __future__ import annotations

import contextlib
import json
import logging
import os
import subprocess
import tempfile
import warnings
import zipfile
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import numpy as np
import onnx
import onnxruntime
import torch
from onnxruntime import quantization
from onnxruntime.quantization import shape_inference
from torch import Tensor, nn

from .data import MARKER_SIDE
from .module import probabilities

OPSET, IR_VERSION = 17, 8  #: what every ONNX Runtime from 1.21 on loads
FORMAT = "1"  #: layout of the metadata
CLASSES = {3: ("free", "obstacle", "promising"), 2: ("other", "promising"), 1: ("promising",)}
COLOURS = {
    "start": [255, 0, 0],
    "goal": [0, 0, 255],
    "free": [255, 255, 255],
    "obstacle": [0, 0, 0],
    "promising": [0, 255, 0],
}
TOLERANCE = 1e-4  #: largest difference of a probability between PyTorch and an fp32 export
METADATA_FILE = "metadata.json"  #: where a TorchScript archive keeps its metadata
QUANTIZED = ["Conv", "Add", "Concat", "Resize", "Relu", "DepthToSpace"]


class _WithProbability(nn.Module):
    def __init__(self, network: nn.Module) -> None:
        super().__init__()
        self.network = network

    def forward(self, image: Tensor) -> Tensor:
        return probabilities(self.network(image))


def _ready(network: nn.Module) -> nn.Module:
    return _WithProbability(network).eval().to(memory_format=torch.contiguous_format)


def commit() -> str:
    """The commit of the training code, marked when that code has changes on top of it; "unknown" outside a checkout."""

    def git(*arguments: str) -> str:
        run = subprocess.run(["git", *arguments], cwd=Path(__file__).parent, capture_output=True, text=True, check=True)
        return run.stdout.strip()

    try:
        return git("rev-parse", "--short=12", "HEAD") + ("-dirty" if git("status", "--porcelain", ".") else "")
    except (OSError, subprocess.CalledProcessError):
        return "unknown"


def metadata(
    name: str,
    size: int,
    classes: int,
    training_data: str,
    training_budget: str,
    training_config: str = "",
    smaller: Sequence[int] = (),
    least_passage: float = 0.0,
) -> dict[str, str]:
    """What the library reads from the file. ``smaller``: sides that may take the place of ``size`` where passages stay
    at least ``least_passage`` input pixels wide."""
    several = {"smaller_inputs": ",".join(map(str, sorted(smaller))), "least_passage": f"{least_passage:g}"}
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
        "training_config": training_config,
        "commit": commit(),
        **(several if smaller else {}),
    }


def properties_of(path: Path) -> dict[str, str]:
    """The metadata of an ONNX file."""
    return {entry.key: entry.value for entry in onnx.load(path).metadata_props}


def save_onnx(graph: onnx.ModelProto, path: Path, properties: dict[str, str]) -> None:
    """Writes a graph with metadata; the file appears only when it is complete."""
    graph.ir_version = IR_VERSION
    onnx.helper.set_model_props(graph, properties)
    onnx.checker.check_model(graph)
    temporary = path.with_name(f".{path.name}.part")
    onnx.save(graph, temporary)
    os.replace(temporary, path)


def export_onnx(network: nn.Module, path: Path, size: int, properties: dict[str, str]) -> None:
    """Writes the network in fp32 with its probabilities as output. The side is left open where the properties name
    smaller inputs."""
    free = {0: "batch", 2: "side", 3: "side"} if "smaller_inputs" in properties else {0: "batch"}
    with tempfile.TemporaryDirectory() as folder, torch.inference_mode():
        plain = Path(folder) / "plain.onnx"
        torch.onnx.export(
            _ready(network),
            (torch.zeros(1, 3, size, size, dtype=torch.uint8),),
            str(plain),
            opset_version=OPSET,
            input_names=["image"],
            output_names=["probability"],
            dynamic_axes={"image": free, "probability": free},
            dynamo=False,
        )
        save_onnx(onnx.load(plain), path, properties)


class _Images(quantization.CalibrationDataReader):
    """Pictures for the calibration, one by one."""

    def __init__(self, images: Iterable[Tensor]) -> None:
        self._images = iter(images)

    def get_next(self) -> dict[str, np.ndarray] | None:
        image = next(self._images, None)
        return None if image is None else {"image": image.numpy()[None]}


@contextlib.contextmanager
def _quiet() -> Iterator[None]:
    """Without the warnings of the quantizer, which names every node that it leaves alone."""
    before = logging.getLogger().level
    logging.getLogger().setLevel(logging.ERROR)
    try:
        yield
    finally:
        logging.getLogger().setLevel(before)


def _take_bytes_as_quantized(graph: onnx.GraphProto) -> None:
    """Lets a picture's bytes be the quantized input: byte / 255 quantized in steps of 1/255 is the byte again.

    Without it the bytes are cast, divided and quantized on one thread before every prediction. A graph that begins in
    another way, or whose calibration pictures had no white pixel, is left as it is.
    """
    followers = {name: node for node in graph.node for name in node.input}
    chain = [followers.get("image")]
    for _ in range(2):
        chain.append(followers.get(chain[-1].output[0]) if chain[-1] is not None else None)
    if [node.op_type if node is not None else "" for node in chain] != ["Cast", "Div", "QuantizeLinear"]:
        return
    constants = {i.name: onnx.numpy_helper.to_array(i) for i in graph.initializer}
    scale, zero = (constants[name] for name in chain[2].input[1:])
    if zero != 0 or not np.isclose(scale, 1 / 255):
        return
    for node in graph.node:
        node.input[:] = ["image" if name == chain[2].output[0] else name for name in node.input]
    for node in chain:
        graph.node.remove(node)
    used = {name for node in graph.node for name in node.input}
    for unused in [i for i in graph.initializer if i.name not in used]:
        graph.initializer.remove(unused)


def export_int8(fp32: Path, path: Path, images: Iterable[Tensor], threshold: float | None = None) -> None:
    """Quantizes an fp32 export: static, per channel, weights int8 and activations uint8 (QDQ).

    Args:
        fp32: file of ``export_onnx``; its metadata are kept.
        path: file to write.
        images: (3, S, S) uint8 each, training pictures that show the range of the activations.
        threshold: threshold for the metadata, where it shall not be that of the fp32 file.
    """
    properties = properties_of(fp32)
    if threshold is not None:
        properties["threshold"] = f"{threshold:g}"
    with tempfile.TemporaryDirectory() as folder, _quiet(), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        prepared, quantized = Path(folder) / "prepared.onnx", Path(folder) / "quantized.onnx"
        shape_inference.quant_pre_process(str(fp32), str(prepared), skip_symbolic_shape=True)
        quantization.quantize_static(
            str(prepared),
            str(quantized),
            _Images(images),
            quant_format=quantization.QuantFormat.QDQ,
            per_channel=True,
            activation_type=quantization.QuantType.QUInt8,
            weight_type=quantization.QuantType.QInt8,
            op_types_to_quantize=QUANTIZED,
        )
        model = onnx.load(quantized)
        _take_bytes_as_quantized(model.graph)
        save_onnx(model, path, properties)


def _without_debug_records(archive: Path) -> None:
    """Drops the records that map code to source lines: they name folders of the machine that exported."""
    slim = archive.with_suffix(".slim")
    with zipfile.ZipFile(archive) as source, zipfile.ZipFile(slim, "w", zipfile.ZIP_STORED) as target:
        for entry in source.infolist():
            if not entry.filename.endswith(".debug_pkl"):
                target.writestr(entry, source.read(entry))
    os.replace(slim, archive)


def export_torchscript(network: nn.Module, path: Path, size: int, properties: dict[str, str]) -> None:
    """Writes the network as a traced TorchScript archive with its metadata inside."""
    temporary = path.with_name(f".{path.name}.part")
    with torch.inference_mode():
        traced = torch.jit.trace(_ready(network), torch.zeros(1, 3, size, size, dtype=torch.uint8))
        torch.jit.save(traced, str(temporary), _extra_files={METADATA_FILE: json.dumps(properties)})
    _without_debug_records(temporary)
    os.replace(temporary, path)


def onnx_probabilities(path: Path, images: Tensor) -> np.ndarray:
    """What ONNX Runtime makes of pictures: (N, 3, S, S) uint8 → (N, K, S, S)."""
    session = onnxruntime.InferenceSession(str(path), providers=["CPUExecutionProvider"])
    return np.concatenate([session.run(["probability"], {"image": image.numpy()[None]})[0] for image in images])


def torchscript_probabilities(path: Path, images: Tensor) -> np.ndarray:
    """What a TorchScript archive makes of pictures."""
    module = torch.jit.load(str(path), map_location="cpu")
    with torch.inference_mode():
        return np.concatenate([module(image[None]).numpy() for image in images])


def own_probabilities(network: nn.Module, images: Tensor) -> np.ndarray:
    """What the network itself makes of pictures."""
    ready = _ready(network)
    with torch.inference_mode():
        return np.concatenate([ready(image[None]).numpy() for image in images])


def parity(network: nn.Module, path: Path, images: Iterable[Tensor]) -> float:
    """Largest difference of any probability between the network and an exported file over pictures, (3, S, S) uint8."""
    exported = torchscript_probabilities if path.suffix == ".pt" else onnx_probabilities
    pairs = ((own_probabilities(network, image[None]), exported(path, image[None])) for image in images)
    return max(float(np.abs(own - other).max()) for own, other in pairs)
