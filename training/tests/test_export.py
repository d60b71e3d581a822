# SPDX-License-Identifier: BSD-3-Clause
"""Exported models: what the file says, and that PyTorch, ONNX Runtime and the library agree on what it computes."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import onnx
import onnxruntime
import pytest
import torch
from helpers import lively_network

import lrrt
from lrrt_training import export
from lrrt_training.data import MazeDataset

SIZE = 64
VARIANTS = [(3, True), (2, True), (3, False)]


@pytest.fixture(scope="module", params=VARIANTS, ids=["full", "two classes", "no ASPP"])
def exported(request, tmp_path_factory):
    """A network and its file."""
    classes, aspp = request.param
    network = lively_network(8, classes, aspp, SIZE)
    path = tmp_path_factory.mktemp("model") / "small.onnx"
    properties = export.metadata("small", SIZE, classes, "small mazes", "none: untrained")
    export.export_onnx(network, path, SIZE, properties)
    return network, path


def images(number: int) -> torch.Tensor:
    return torch.randint(0, 256, (number, 3, SIZE, SIZE), dtype=torch.uint8, generator=torch.Generator().manual_seed(5))


def test_file_is_what_the_runtimes_load(exported):
    network, path = exported
    model = onnx.load(path)
    assert model.ir_version == 8
    assert {o.domain: o.version for o in model.opset_import} == {"": 17}
    session = onnxruntime.InferenceSession(str(path), providers=["CPUExecutionProvider"])
    (image,), (probability,) = session.get_inputs(), session.get_outputs()
    classes = network.classifier.out_channels
    assert (image.name, image.type, image.shape[1:]) == ("image", "tensor(uint8)", [3, SIZE, SIZE])
    assert (probability.name, probability.type) == ("probability", "tensor(float)")
    assert isinstance(image.shape[0], str), "any number of pictures at once"
    assert session.run(None, {"image": images(2).numpy()})[0].shape == (2, classes, SIZE, SIZE)
    assert [p.name for p in path.parent.iterdir()] == ["small.onnx"], "no temporary file stays"


def test_metadata(exported):
    network, path = exported
    found = {p.key: p.value for p in onnx.load(path).metadata_props}
    colours = json.loads(found.pop("colours"))
    assert colours == {
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
        "classes": "free,obstacle,promising" if network.classifier.out_channels == 3 else "other,promising",
        "threshold": "0.5",
        "training_data": "small mazes",
        "training_budget": "none: untrained",
        "commit": export.commit(),
    }


@pytest.mark.parametrize("number", [1, 3])
def test_parity_with_pytorch(exported, number):
    network, path = exported
    pictures = images(number)
    with torch.inference_mode():
        probability = network(pictures).softmax(dim=1)
    assert probability.max() - probability.min() > 0.5, "a constant would agree with anything"
    session = onnxruntime.InferenceSession(str(path), providers=["CPUExecutionProvider"])
    (found,) = session.run(["probability"], {"image": pictures.numpy()})
    assert np.abs(found - probability.numpy()).max() < export.TOLERANCE
    assert found.sum(axis=1) == pytest.approx(1.0, abs=1e-5)
    assert export.parity(network, path, pictures) < export.TOLERANCE


def test_parity_notices_another_network(exported):
    network, path = exported
    other = lively_network(8, network.classifier.out_channels, size=SIZE)
    torch.nn.init.normal_(other.classifier.weight)
    assert export.parity(other, path, images(1)) > 0.1


def test_library_reads_the_file(exported):
    network, path = exported
    info = lrrt.OnnxPredictor(path, threads=1).info
    classes = export.CLASSES[network.classifier.out_channels]
    assert (info.name, info.input_size, info.marker_side, tuple(info.classes)) == ("small", SIZE, 5, classes)
    assert info.threshold == pytest.approx(0.5)
    assert (info.training_data, info.training_budget) == ("small mazes", "none: untrained")
    assert info.commit == export.commit()
    assert Path(info.path) == path


def test_library_predicts_what_pytorch_computes(exported, store):
    network, path = exported
    predictor, encoder = lrrt.OnnxPredictor(path, threads=1), lrrt.Encoder(size=SIZE, marker_side=5)
    samples = MazeDataset(store, "test", [7, 13, 21], SIZE, 100)
    for i in range(6):
        scene = samples.scene(i)
        occupancy = scene.occupancy_map()
        encoding = encoder.encode(occupancy, scene.start, scene.goal)
        with torch.inference_mode():
            scores = network(torch.from_numpy(np.array(encoding.image))[None])
        expected = encoding.to_map(scores.softmax(dim=1)[0, -1].numpy())
        found = predictor.predict(occupancy, scene.start, scene.goal).probability
        assert found.shape == expected.shape == (occupancy.height, occupancy.width)
        assert np.abs(found - expected).max() < export.TOLERANCE
        assert expected.max() - expected.min() > 0.2


def test_failed_export_leaves_the_old_file(tmp_path, monkeypatch):
    path = tmp_path / "small.onnx"
    path.write_text("old")
    monkeypatch.setattr(export.onnx.checker, "check_model", lambda _: pytest.fail("broken graph"))
    with pytest.raises(pytest.fail.Exception, match="broken graph"):
        export.export_onnx(lively_network(4, size=32), path, 32, {})
    assert path.read_text() == "old"


def test_commit_outside_a_checkout(monkeypatch):
    def without_git(*_, **__):
        raise FileNotFoundError("git")

    monkeypatch.setattr(export.subprocess, "run", without_git)
    assert export.commit() == "unknown"
