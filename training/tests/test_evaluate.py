# SPDX-License-Identifier: BSD-3-Clause
"""Scores of models whose quality is known, and where they are written."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

import numpy as np
import pytest
import torch
from helpers import lively_network
from PIL import Image

from lrrt_training import evaluate as scoring
from lrrt_training import export
from lrrt_training.data import MazeDataset

SIZE, LEVELS, MAZES = 64, [7, 11], 4
PERFECT = {"accuracy": 1.0, "redundancy": 0.0, "metric": 0.0, "connectivity": 1.0}
SCORES = {
    21: {"accuracy": 0.9876, "redundancy": 0.05, "metric": 0.0624, "connectivity": 0.9, "count": 200},
    "all": {"accuracy": 0.9876, "redundancy": 0.05, "metric": 0.0624, "connectivity": 0.9, "count": 200},
}


class Fake:
    """A model that looks the answer up."""

    path, size, threshold = Path("fake.onnx"), SIZE, 0.5

    def __init__(self, store, answer, split="test") -> None:
        dataset = MazeDataset(store, split, LEVELS, SIZE, MAZES * len(LEVELS), in_turn=True)
        samples = [dataset[i] for i in range(len(dataset))]
        self.answers = {s["image"].numpy().tobytes(): answer(s).numpy().astype(np.float32) for s in samples}

    def probability(self, image: torch.Tensor) -> np.ndarray:
        return self.answers[image.numpy().tobytes()]


@pytest.fixture(scope="module")
def model(tmp_path_factory) -> scoring.OnnxModel:
    path = tmp_path_factory.mktemp("models") / "small.onnx"
    properties = export.metadata("small", SIZE, 2, "small mazes", "none: untrained")
    export.export_onnx(lively_network(4, 2, size=SIZE), path, SIZE, properties)
    return scoring.OnnxModel(path, threads=1)


def test_a_perfect_model_scores_perfectly(store):
    scores = scoring.evaluate(Fake(store, lambda s: s["label"] == 2), store, LEVELS, MAZES)
    assert scores[7] == scores[11] == {**PERFECT, "count": MAZES}
    assert scores["all"] == {**PERFECT, "count": 2 * MAZES}


def test_the_threshold_belongs_to_the_region(store):
    """A pixel is promising from the threshold on, as in the library."""
    at, below = (
        scoring.evaluate(Fake(store, lambda s, v=v: v * (s["label"] == 2)), store, LEVELS, MAZES) for v in (0.5, 0.4999)
    )
    assert at["all"]["accuracy"] == 1.0
    assert below["all"] == {**PERFECT, "accuracy": 0.0, "metric": 1.0, "connectivity": 0.0, "count": 2 * MAZES}


def test_the_metric_tells_the_best_threshold(store):
    """Free pixels at 0.6 are redundant below that threshold, the path at 0.8 is missed above that one."""
    values = torch.tensor([0.6, 0.1, 0.8])
    fake = Fake(store, lambda s: values[s["label"].long()], "evaluation")
    low, between, high = scoring.metric_by_threshold(fake, store, LEVELS, MAZES, [0.5, 0.7, 0.9])
    assert low > 0.5 and between == 0.0 and high == 1.0


def test_a_threshold_is_written_into_the_file(model, tmp_path):
    path = tmp_path / "copy.onnx"
    path.write_bytes(model.path.read_bytes())
    scoring.write_threshold(path, 0.65)
    copy = scoring.OnnxModel(path, threads=1)
    assert copy.threshold == 0.65
    assert {k: v for k, v in copy.properties.items() if k != "threshold"} == {
        k: v for k, v in model.properties.items() if k != "threshold"
    }
    assert list(tmp_path.iterdir()) == [path]


def test_a_model_that_marks_everything_is_redundant(store):
    scores = scoring.evaluate(Fake(store, lambda s: s["label"] >= 0), store, LEVELS, MAZES)["all"]
    assert scores["accuracy"] == scores["connectivity"] == 1.0
    assert scores["redundancy"] > 0.5


def test_exported_model_takes_the_promising_class(model):
    image = torch.randint(0, 256, (3, SIZE, SIZE), dtype=torch.uint8)
    (both,) = model.session.run(["probability"], {"image": image.numpy()[None]})
    assert (model.size, model.threshold, model.promising) == (SIZE, 0.5, 1)
    assert np.array_equal(model.probability(image), both[0, 1])


def test_exported_model_is_scored(model, store):
    scores = scoring.evaluate(model, store, LEVELS, 2)
    assert list(scores) == [7, 11, "all"]
    assert all(0 <= row["accuracy"] <= 1 and row["count"] in (2, 4) for row in scores.values())


def test_manifest_has_one_entry_a_model(model, tmp_path):
    path = tmp_path / "manifest.json"
    path.write_text(json.dumps({"models": {"other.onnx": {"bytes": 1}}}))
    for _ in range(2):
        scoring.write_manifest(tmp_path, model, SCORES, "test")
        once = path.read_text()
    manifest = json.loads(once)["models"]
    assert set(manifest) == {"other.onnx", "small.onnx"}
    entry, content = manifest["small.onnx"], model.path.read_bytes()
    assert entry["sha256"] == hashlib.sha256(content).hexdigest()
    assert entry["bytes"] == len(content)
    assert (entry["name"], entry["input_size"], entry["split"]) == ("small", "64", "test")
    assert entry["training_budget"] == "none: untrained"
    assert entry["scores"]["21"]["accuracy"] == 0.9876
    assert entry["scores"]["all"]["count"] == 200
    assert 10_000 < entry["parameters"] < len(content) / 4


def test_manifest_is_begun_where_there_is_none(model, tmp_path):
    scoring.write_manifest(tmp_path, model, SCORES, "evaluation")
    assert [p.name for p in tmp_path.iterdir()] == ["manifest.json"]
    assert json.loads((tmp_path / "manifest.json").read_text())["models"]["small.onnx"]["split"] == "evaluation"


def test_card_table_is_replaced(tmp_path):
    card = tmp_path / "README.md"
    card.write_text(f"# Model\n\n{scoring.CARD_BEGIN}\nold\n{scoring.CARD_END}\n\nLimits.\n")
    scoring.write_card_table(card, SCORES)
    once = card.read_text()
    assert "old" not in once
    assert "| 21 | 0.988 | 0.050 | 0.062 | 90.0 % | 200 |" in once
    assert once.startswith(f"# Model\n\n{scoring.CARD_BEGIN}\n| blocks |")
    assert once.endswith(f"|\n{scoring.CARD_END}\n\nLimits.\n")
    scoring.write_card_table(card, SCORES)
    assert card.read_text() == once


@pytest.mark.parametrize(
    "text", ["# Model\n", f"{scoring.CARD_BEGIN}\n", f"{scoring.CARD_END}\n{scoring.CARD_BEGIN}\n"]
)
def test_card_without_marks_is_an_error(tmp_path, text):
    card = tmp_path / "README.md"
    card.write_text(text)
    with pytest.raises(ValueError, match=r"README\.md: expected the lines"):
        scoring.write_card_table(card, SCORES)
    assert card.read_text() == text


def test_contact_sheet_is_a_picture(store, tmp_path):
    truth = Fake(store, lambda s: s["label"] == 2)
    scoring.contact_sheet(truth, store, LEVELS, tmp_path / "sheet.png", columns=2)
    with Image.open(tmp_path / "sheet.png") as picture:
        colours = {c for _, c in picture.convert("RGB").getcolors(1 << 24)}
    assert (60, 180, 75) in colours, "what was found"
    assert (230, 50, 160) not in colours, "nothing was missed"
