# SPDX-License-Identifier: BSD-3-Clause
"""Scores of models whose quality is known, and where they are written."""

from __future__ import annotations

import hashlib
import json
from types import SimpleNamespace

import numpy as np
import pytest
from helpers import lively_network
from PIL import Image
from scipy import ndimage

import lrrt
from lrrt_training import evaluate as scoring
from lrrt_training import export
from lrrt_training.families.external import ExternalMaps
from lrrt_training.scenes import MazeScene, SceneSource

SIZE, MAPS = 64, 3
BEGIN, END = scoring.CARD_MARKS
PERFECT = {"accuracy": 1.0, "redundancy": 0.0, "metric": 0.0, "connectivity": 1.0, "linked": 0.0}
SCORES = {
    "21": {"accuracy": 0.98764, "redundancy": 0.05, "metric": 0.0624, "connectivity": 0.9, "linked": 0.0, "count": 200},
    "all": {
        "accuracy": 0.98764,
        "redundancy": 0.05,
        "metric": 0.0624,
        "connectivity": 0.9,
        "linked": 0.0,
        "count": 200,
    },
}


class Fake:
    """A model that knows the scenes: its probability is a function of their label."""

    def __init__(self, groups: scoring.Groups, answer, split: str = "test", threshold: float = 0.5) -> None:
        self.info = SimpleNamespace(name="fake", input_size=SIZE, smaller_inputs=[], least_passage=5.0)
        self.threshold, self.answers = threshold, {}
        for group in groups:
            for number in range(MAPS):
                scene = scoring.scene_of(groups, group, number, split)
                grid = scene.occupancy_map()
                scale = lrrt.Encoder(size=SIZE).encode(grid, scene.start, scene.goal).scale
                self.answers[grid.cells.tobytes(), scene.start, scene.goal] = answer(scene.label(scale))

    def predict(self, grid, start, goal) -> lrrt.PromisingRegion:
        probability = self.answers[grid.cells.tobytes(), start, goal].astype(np.float32)
        return lrrt.PromisingRegion.from_array(grid, probability, start, goal, threshold=self.threshold)


def groups_of(store, split: str) -> scoring.Groups:
    """Two levels and a family."""
    made = SceneSource(store, ExternalMaps("absent"), split).groups([7, 11], SIZE)
    return {group: made[group] for group in ("7", "11", "city")}


@pytest.fixture(scope="module")
def groups(store) -> scoring.Groups:
    return groups_of(store, "test")


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    path = tmp_path_factory.mktemp("models") / "small.onnx"
    properties = export.metadata("small", SIZE, 1, "small mazes", "none: untrained")
    export.export_onnx(lively_network(1, SIZE), path, SIZE, properties)
    return path


def test_scenes_hang_on_group_number_and_split_alone(store):
    def drawn(split: str, group: str, number: int) -> bytes:
        scene = scoring.scene_of(groups_of(store, split), group, number, split)
        return scene.occupancy_map().cells.tobytes() + repr((scene.start, scene.goal)).encode()

    for group in ("7", "city"):
        assert drawn("test", group, 1) == drawn("test", group, 1)
        others = {drawn("test", group, 1), drawn("test", group, 2), drawn("evaluation", group, 1)}
        assert len(others) == 3


def test_different_mazes_of_a_level(groups, store):
    scenes = [scoring.scene_of(groups, "11", number, "test") for number in range(6)]
    assert all(isinstance(scene, MazeScene) for scene in scenes)
    stored = [121 - np.unpackbits(bits).sum() for bits in store.mazes("test", 11)]
    assert [(~scene.blocks).sum() for scene in scenes] == stored


def test_a_perfect_model_scores_perfectly(groups):
    scores = scoring.evaluate(Fake(groups, lambda label: label == 2), groups, MAPS)
    assert list(scores) == ["7", "11", "city", "perfect mazes", "looped mazes", "all"]
    assert all(scores[group] == {**PERFECT, "count": MAPS} for group in groups)
    assert scores["perfect mazes"]["count"] + scores["looped mazes"]["count"] == 2 * MAPS
    assert scores["all"] == {**PERFECT, "count": 3 * MAPS}


def test_scores_against_a_slow_reference(groups):
    """Noise from 0.4 to 0.6 around the threshold, counted in map pixels without the code under test."""
    rng = np.random.default_rng(1)
    noise: list[tuple[np.ndarray, np.ndarray]] = []

    def noisy(label: np.ndarray) -> np.ndarray:
        noise.append((label, np.float32(0.4) + np.float32(0.2) * rng.random(label.shape, dtype=np.float32)))
        return noise[-1][1]

    scores = scoring.evaluate(Fake(groups, noisy), groups, MAPS)
    rows = []
    for i, (label, probability) in enumerate(noise):
        mask = (probability >= 0.5) & (label != 1)
        path = label == 2
        scene = scoring.scene_of(groups, list(groups)[i // MAPS], i % MAPS, "test")
        parts = ndimage.label(mask, np.ones((3, 3)))[0]
        a, b = (parts[int(y), int(x)] for x, y in (scene.start, scene.goal))
        rows.append(((mask & path).sum() / path.sum(), (mask & ~path).sum() / path.sum(), a == b > 0))
    for k, group in enumerate(groups):
        accuracy, redundancy, _ = np.mean(rows[MAPS * k : MAPS * (k + 1)], axis=0)
        assert scores[group]["accuracy"] == pytest.approx(accuracy)
        assert scores[group]["redundancy"] == pytest.approx(redundancy)
        assert scores[group]["metric"] == pytest.approx(1 - accuracy + redundancy)
    assert scores["all"]["accuracy"] == pytest.approx(np.mean([row[0] for row in rows]))
    assert scores["all"]["connectivity"] <= np.mean([row[2] for row in rows]), "no corner is cut"


def test_raw_scores_know_neither_links_nor_what_the_library_drops(groups, model):
    """The library's regions join more often and hold what the threshold marks, but for parts that nothing joins."""
    predictor = lrrt.OnnxPredictor(model, threads=1)
    raw, whole = (scoring.evaluate(predictor, groups, MAPS, raw=raw)["all"] for raw in (True, False))
    assert raw["linked"] == 0.0
    assert raw["connectivity"] == pytest.approx(whole["connectivity"] - whole["linked"])
    for group in groups:
        for number in range(MAPS):
            judged = scoring.Judged(predictor, scoring.scene_of(groups, group, number, "test"))
            alone = judged.by_threshold(predictor.info.threshold)
            assert (alone == ((judged.region.probability >= predictor.info.threshold) & (judged.label != 1))).all()
            if not judged.region.connected:
                assert (alone == judged.region.mask).all()


def test_the_threshold_belongs_to_the_region(groups):
    """A pixel is promising from the threshold on, as in the library."""
    at, below = (scoring.evaluate(Fake(groups, lambda lab, v=v: v * (lab == 2)), groups, MAPS) for v in (0.5, 0.4999))
    assert at["all"]["accuracy"] == 1.0
    assert below["all"] == {
        **PERFECT,
        "accuracy": 0.0,
        "metric": 1.0,
        "connectivity": 0.0,
        "linked": 0.0,
        "count": 3 * MAPS,
    }


def test_a_model_that_marks_everything_is_redundant(groups):
    scores = scoring.evaluate(Fake(groups, lambda label: label >= 0), groups, MAPS)["all"]
    assert scores["accuracy"] == scores["connectivity"] == 1.0
    assert scores["redundancy"] > 0.5


def test_the_metric_tells_the_best_threshold(store):
    """Free pixels at 0.6 are redundant below that threshold, the path at 0.8 is missed above that one."""
    groups, values = groups_of(store, "evaluation"), np.array([0.6, 0.1, 0.8])
    fake = Fake(groups, lambda label: values[label], "evaluation")
    low, between, high = scoring.metric_by_threshold(fake, groups, MAPS, [0.5, 0.7, 0.9])
    assert low[0] > 0.5 and between[0] == 0.0 and high[0] == 1.0
    assert (low[1], between[1], high[1]) == (1.0, 1.0, 0.0), "joined, joined, broken"


def test_a_threshold_is_written_into_the_file(model, tmp_path):
    path = tmp_path / "copy.onnx"
    path.write_bytes(model.read_bytes())
    scoring.write_threshold(path, 0.65)
    assert lrrt.OnnxPredictor(path, threads=1).info.threshold == pytest.approx(0.65)
    before, after = export.properties_of(model), export.properties_of(path)
    assert (before.pop("threshold"), after.pop("threshold")) == ("0.5", "0.65")
    assert after == before
    assert list(tmp_path.iterdir()) == [path]


def test_exported_model_is_scored(model, groups):
    scores = scoring.evaluate(lrrt.OnnxPredictor(model, threads=1), groups, 2)
    assert [scores[group]["count"] for group in ("7", "11", "city", "all")] == [2, 2, 2, 6]
    assert all(0 <= row["accuracy"] <= 1 for row in scores.values())


def test_manifest_has_one_entry_a_model(model, tmp_path):
    path = tmp_path / "manifest.json"
    path.write_text(json.dumps({"models": {"other.onnx": {"bytes": 1}}}))
    for _ in range(2):
        scoring.write_manifest(tmp_path, model, SCORES, "test")
        once = path.read_text()
    manifest = json.loads(once)["models"]
    assert set(manifest) == {"other.onnx", "small.onnx"}
    entry, content = manifest["small.onnx"], model.read_bytes()
    assert entry["sha256"] == hashlib.sha256(content).hexdigest()
    assert entry["bytes"] == len(content)
    assert (entry["name"], entry["input_size"], entry["threshold"], entry["split"]) == ("small", "64", "0.5", "test")
    assert (entry["training_budget"], entry["training_config"]) == ("none: untrained", "")
    assert entry["commit"] == export.commit()
    assert entry["scores"]["21"]["accuracy"] == 0.9876
    assert entry["scores"]["all"]["count"] == 200
    assert [p.name for p in tmp_path.iterdir()] == ["manifest.json"]


def test_manifest_is_begun_where_there_is_none(model, tmp_path):
    scoring.write_manifest(tmp_path, model, SCORES, "evaluation")
    assert json.loads((tmp_path / "manifest.json").read_text())["models"]["small.onnx"]["split"] == "evaluation"


def test_card_table_is_replaced(tmp_path):
    card = tmp_path / "README.md"
    card.write_text(f"# Model\n\n{BEGIN}\nold\n{END}\n\nLimits.\n")
    scoring.write_between_marks(card, scoring.markdown_table(SCORES))
    once = card.read_text()
    assert "old" not in once
    assert "| 21 | 0.988 | 0.050 | 0.062 | 90.0 % | 0.0 % | 200 |" in once
    assert once.startswith(f"# Model\n\n{BEGIN}\n| maps |")
    assert once.endswith(f"|\n{END}\n\nLimits.\n")
    scoring.write_between_marks(card, scoring.markdown_table(SCORES))
    assert card.read_text() == once


@pytest.mark.parametrize("text", ["# Model\n", f"{BEGIN}\n", f"{END}\n{BEGIN}\n"])
def test_card_without_marks_is_an_error(tmp_path, text):
    card = tmp_path / "README.md"
    for content in (None, text):
        if content is not None:
            card.write_text(content)
        for call in (scoring.split_at_marks, lambda path: scoring.write_between_marks(path, "table")):
            with pytest.raises(ValueError, match=r"README\.md: expected the lines"):
                call(card)
    assert card.read_text() == text


def test_worst_cases_come_first(groups):
    """A model that knows all but one scene of each group, of which it marks nothing."""
    wrong = {group: k % MAPS for k, group in enumerate(groups)}
    truth = Fake(groups, lambda label: label == 2)
    for group, number in wrong.items():
        scene = scoring.scene_of(groups, group, number, "test")
        key = (scene.occupancy_map().cells.tobytes(), scene.start, scene.goal)
        truth.answers[key] = np.zeros_like(truth.answers[key])
    worst = scoring.worst_cases(truth, groups, MAPS, columns=2)
    assert {group: numbers[0] for group, numbers in worst.items()} == wrong
    assert all(len(numbers) == 2 for numbers in worst.values())


def test_contact_sheet_is_a_picture(groups, tmp_path):
    truth = Fake(groups, lambda label: label == 2)
    scoring.contact_sheet(truth, groups, tmp_path / "sheet.png", columns=2)
    with Image.open(tmp_path / "sheet.png") as picture:
        colours = {c for _, c in picture.convert("RGB").getcolors(1 << 24)}
    assert (60, 180, 75) in colours, "what was found"
    assert (230, 50, 160) not in colours, "nothing was missed"
    assert (255, 200, 60) not in colours, "nothing is too much"


def test_colours_of_the_sheet(groups):
    """Half of the path is missed, half of the free pixels are too much."""
    upper = np.zeros((2000, 2000), dtype=bool)
    upper[::2] = True
    fake = Fake(groups, lambda label: upper[: label.shape[0], : label.shape[1]])
    scene = scoring.scene_of(groups, "city", 0, "test")
    judged = scoring.Judged(fake, scene)
    picture, marked = scoring.verdict_picture(judged), judged.region.mask
    kinds = {
        (0, 0, 0): judged.label == 1,
        (255, 255, 255): (judged.label == 0) & ~marked,
        (255, 200, 60): (judged.label == 0) & marked,
        (60, 180, 75): (judged.label == 2) & marked,
        (230, 50, 160): (judged.label == 2) & ~marked,
    }
    for colour, where in kinds.items():
        assert where.any()
        assert np.array_equal((picture == colour).all(axis=2), where)
