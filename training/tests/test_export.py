# SPDX-License-Identifier: BSD-3-Clause
"""Exported models: what the file says, and that PyTorch, ONNX Runtime and the library agree on what it computes."""

from __future__ import annotations

import json
import logging
from pathlib import Path

import numpy as np
import onnx
import onnxruntime
import pytest
import torch
from helpers import lively, lively_network

import lrrt
from lrrt_training import export
from lrrt_training.families.external import ExternalMaps
from lrrt_training.fast_network import FastNetwork
from lrrt_training.module import probabilities
from lrrt_training.paper_network import PaperNetwork
from lrrt_training.scenes import SceneSource

SIZE = 64
CLASSES = {1: ("promising",), 2: ("other", "promising"), 3: ("free", "obstacle", "promising")}


def images(number: int) -> torch.Tensor:
    return torch.randint(0, 256, (number, 3, SIZE, SIZE), dtype=torch.uint8, generator=torch.Generator().manual_seed(5))


def properties(classes: int) -> dict[str, str]:
    return export.metadata("small", SIZE, classes, "small mazes", "none: untrained", "tiny")


def as_loaded(path: Path) -> onnxruntime.InferenceSession:
    return onnxruntime.InferenceSession(str(path), providers=["CPUExecutionProvider"])


@pytest.fixture(scope="module", params=[1, 2, 3], ids=lambda k: f"{k} classes")
def exported(request, tmp_path_factory):
    """A network and its file."""
    network = lively_network(request.param, SIZE)
    path = tmp_path_factory.mktemp("model") / "small.onnx"
    export.export_onnx(network, path, SIZE, properties(request.param))
    return network, path


@pytest.fixture(scope="module")
def quantized(tmp_path_factory):
    """A network of useful width, its fp32 file and its int8 file."""
    torch.manual_seed(4)
    network = lively(FastNetwork(16, (32, 48, 64), passes=2), SIZE)
    folder = tmp_path_factory.mktemp("int8")
    export.export_onnx(network, folder / "fp32.onnx", SIZE, properties(1))
    export.export_int8(folder / "fp32.onnx", folder / "int8.onnx", images(6), threshold=0.35)
    return network, folder / "fp32.onnx", folder / "int8.onnx"


def test_file_is_what_the_runtimes_load(exported):
    network, path = exported
    model = onnx.load(path)
    assert model.ir_version == 8
    assert {o.domain: o.version for o in model.opset_import} == {"": 17}
    session = as_loaded(path)
    (image,), (probability,) = session.get_inputs(), session.get_outputs()
    assert (image.name, image.type, image.shape[1:]) == ("image", "tensor(uint8)", [3, SIZE, SIZE])
    assert (probability.name, probability.type) == ("probability", "tensor(float)")
    assert isinstance(image.shape[0], str), "any number of pictures at once"
    assert session.run(None, {"image": images(2).numpy()})[0].shape == (2, network.classes, SIZE, SIZE)
    assert [p.name for p in path.parent.iterdir()] == ["small.onnx"], "no temporary file stays"


def test_metadata(exported):
    network, path = exported
    found = export.properties_of(path)
    assert json.loads(found.pop("colours")) == {
        "start": [255, 0, 0],
        "goal": [0, 0, 255],
        "free": [255, 255, 255],
        "obstacle": [0, 0, 0],
        "promising": [0, 255, 0],
    }
    assert found == {
        "lrrt_format": "1",
        "name": "small",
        "input_size": "64",
        "marker_side": "5",
        "classes": ",".join(CLASSES[network.classes]),
        "threshold": "0.5",
        "training_data": "small mazes",
        "training_budget": "none: untrained",
        "training_config": "tiny",
        "commit": export.commit(),
    }


@pytest.mark.parametrize("number", [1, 3])
def test_parity_with_pytorch(exported, number):
    network, path = exported
    pictures = images(number)
    with torch.inference_mode():
        probability = probabilities(network(pictures))
    assert probability.max() - probability.min() > 0.5, "a constant would agree with anything"
    (found,) = as_loaded(path).run(["probability"], {"image": pictures.numpy()})
    assert np.abs(found - probability.numpy()).max() < export.TOLERANCE
    if network.classes > 1:
        assert found.sum(axis=1) == pytest.approx(1.0, abs=1e-5)
    assert export.parity(network, path, pictures) < export.TOLERANCE


@pytest.mark.parametrize("kind", ["fp32", "int8", "torchscript"])
def test_a_file_for_several_sides_takes_each_of_them(tmp_path, kind):
    torch.manual_seed(4)
    network = lively(FastNetwork(8, (16, 24), passes=2), SIZE)
    stated = export.metadata("small", SIZE, 1, "small mazes", "none: untrained", smaller=[48, 32], least_passage=5)
    pictures = [torch.randint(0, 256, (3, side, side), dtype=torch.uint8) for side in (SIZE, 48, 32)]
    path = tmp_path / ("m.pt" if kind == "torchscript" else "m.onnx")
    if kind == "torchscript":
        export.export_torchscript(network, path, SIZE, stated)
    else:
        export.export_onnx(network, path, SIZE, stated)
        info = lrrt.OnnxPredictor(path, threads=1).info
        assert (info.input_size, info.smaller_inputs, info.least_passage) == (SIZE, [32, 48], 5.0)
        if kind == "int8":
            export.export_int8(path, path, pictures)
            assert lrrt.OnnxPredictor(path, threads=1).info.smaller_inputs == [32, 48]
    assert export.parity(network, path, pictures) < (0.1 if kind == "int8" else export.TOLERANCE)


def test_parity_without_aspp(tmp_path):
    torch.manual_seed(4)
    network = lively(PaperNetwork(4, aspp=False), SIZE)
    export.export_onnx(network, tmp_path / "m.onnx", SIZE, properties(3))
    assert export.parity(network, tmp_path / "m.onnx", images(1)) < export.TOLERANCE


def test_parity_notices_another_network(exported):
    network, path = exported
    other = lively_network(network.classes, SIZE)
    torch.nn.init.normal_(other.classifier.weight)
    assert export.parity(other, path, images(1)) > 0.1


def test_torchscript_computes_the_same_and_carries_the_metadata(exported, tmp_path):
    network, path = exported
    archive = tmp_path / "small.pt"
    export.export_torchscript(network, archive, SIZE, properties(network.classes))
    assert export.parity(network, archive, images(2)) < export.TOLERANCE
    files = {export.METADATA_FILE: ""}
    torch.jit.load(str(archive), _extra_files=files)
    assert json.loads(files[export.METADATA_FILE]) == export.properties_of(path)
    assert [p.name for p in tmp_path.iterdir()] == ["small.pt"], "no temporary file stays"


def test_library_reads_the_file(exported):
    network, path = exported
    info = lrrt.OnnxPredictor(path, threads=1).info
    found = (info.name, info.input_size, info.marker_side, tuple(info.classes))
    assert found == ("small", SIZE, 5, CLASSES[network.classes])
    assert info.threshold == pytest.approx(0.5)
    assert (info.training_data, info.training_budget) == ("small mazes", "none: untrained")
    assert info.commit == export.commit()
    assert Path(info.path) == path


def test_library_predicts_what_pytorch_computes(exported, store):
    network, path = exported
    predictor, encoder = lrrt.OnnxPredictor(path, threads=1), lrrt.Encoder(size=SIZE, marker_side=5)
    groups = SceneSource(store, ExternalMaps("absent"), "test").groups([7, 13, 21], SIZE)
    for number, group in enumerate(("7", "13", "21", "rooms")):
        scene = groups[group](np.random.default_rng(number), number)
        occupancy = scene.occupancy_map()
        encoding = encoder.encode(occupancy, scene.start, scene.goal)
        with torch.inference_mode():
            scores = network(torch.from_numpy(np.array(encoding.image))[None])
        expected = encoding.to_map(probabilities(scores)[0, -1].numpy())
        found = predictor.predict(occupancy, scene.start, scene.goal).probability
        assert found.shape == expected.shape == (occupancy.height, occupancy.width)
        assert np.abs(found - expected).max() < export.TOLERANCE
        assert expected.max() - expected.min() > 300 * export.TOLERANCE


def test_int8_file_is_quantized_and_smaller(quantized):
    _, fp32, int8 = quantized
    graph = onnx.load(int8).graph
    kinds = [node.op_type for node in graph.node]
    assert kinds.count("QuantizeLinear") > 5 and kinds.count("DequantizeLinear") > 5
    weights = [t for t in graph.initializer if len(t.dims) == 4]
    assert weights and {t.data_type for t in weights} == {onnx.TensorProto.INT8}
    scales = {t.name: t for t in graph.initializer if t.name.endswith("_scale") and "weight" in t.name}
    assert any(list(t.dims)[:1] not in ([], [1]) for t in scales.values()), "a scale for every channel"
    assert int8.stat().st_size < 0.5 * fp32.stat().st_size


@pytest.mark.parametrize("brightest", [255, 127])
def test_bytes_are_the_quantized_input_where_their_range_is_whole(quantized, tmp_path, brightest):
    pictures = images(3) // (256 // (brightest + 1))
    export.export_int8(quantized[1], tmp_path / "m.onnx", pictures)
    nodes = onnx.load(tmp_path / "m.onnx").graph.node
    used = [node.op_type for node in nodes if node.op_type in ("Cast", "Div") or "image" in node.input]
    assert used == (["DequantizeLinear"] if brightest == 255 else ["Cast", "Div"])
    close = export.onnx_probabilities(tmp_path / "m.onnx", pictures) - export.own_probabilities(quantized[0], pictures)
    assert np.abs(close).mean() < 0.05


def test_int8_file_keeps_the_metadata(quantized):
    _, fp32, int8 = quantized
    before, after = export.properties_of(fp32), export.properties_of(int8)
    assert before.pop("threshold") == "0.5" and after.pop("threshold") == "0.35"
    assert after == before
    assert onnx.load(int8).ir_version == 8


def test_int8_file_runs_in_onnx_runtime_and_in_the_library(quantized, store):
    network, _, int8 = quantized
    found, own = export.onnx_probabilities(int8, images(3)), export.own_probabilities(network, images(3))
    assert found.shape == own.shape == (3, 1, SIZE, SIZE)
    assert found.min() >= 0 and found.max() <= 1
    assert np.abs(found - own).mean() < 0.1, "coarse, but the same function"
    predictor = lrrt.OnnxPredictor(int8, threads=1)
    assert (predictor.info.input_size, tuple(predictor.info.classes)) == (SIZE, ("promising",))
    assert predictor.info.threshold == pytest.approx(0.35)
    groups = SceneSource(store, ExternalMaps("absent"), "test").groups([13], SIZE)
    scene = groups["13"](np.random.default_rng(0), 0)
    region = predictor.predict(scene.occupancy_map(), scene.start, scene.goal)
    assert region.probability.max() - region.probability.min() > 0.03


def test_quantizing_leaves_the_log_level_alone(quantized, tmp_path):
    _, fp32, _ = quantized
    before = logging.getLogger().level
    export.export_int8(fp32, tmp_path / "m.onnx", images(1))
    assert logging.getLogger().level == before
    assert export.properties_of(tmp_path / "m.onnx")["threshold"] == "0.5", "that of the fp32 file"
    assert [p.name for p in tmp_path.iterdir()] == ["m.onnx"]


@pytest.mark.parametrize("kind", ["fp32", "int8", "torchscript"])
def test_failed_export_leaves_the_old_file(quantized, tmp_path, monkeypatch, kind):
    network, fp32, _ = quantized
    path = tmp_path / "small.onnx"
    path.write_text("old")

    def full(*_, **__):
        raise OSError("no space left on device")

    monkeypatch.setattr(export.onnx, "save", full) if kind == "fp32" else None
    monkeypatch.setattr(export.onnx.checker, "check_model", full) if kind == "int8" else None
    monkeypatch.setattr(export.torch.jit, "save", full) if kind == "torchscript" else None
    with pytest.raises(OSError, match="no space"):
        if kind == "int8":
            export.export_int8(fp32, path, images(1))
        else:
            write = export.export_onnx if kind == "fp32" else export.export_torchscript
            write(network, path, SIZE, properties(1))
    assert path.read_text() == "old"


def test_commit_outside_a_checkout(monkeypatch):
    def without_git(*_, **__):
        raise FileNotFoundError("git")

    monkeypatch.setattr(export.subprocess, "run", without_git)
    assert export.commit() == "unknown"
