# SPDX-License-Identifier: BSD-3-Clause
"""Scores of an exported model on held-out mazes, and where they are shown: manifest, card table, contact sheet."""

from __future__ import annotations

import hashlib
import json
import os
from pathlib import Path
from typing import Any

import numpy as np
import onnx
import onnxruntime
import torch
from matplotlib.figure import Figure
from rich.progress import track
from rich.table import Table

from .data import MazeDataset
from .metrics import RegionMetrics, accuracy, redundancy
from .store import MazeStore

Scores = dict[int | str, dict[str, float]]
CARD_BEGIN, CARD_END = "<!-- scores: written by the evaluate command -->", "<!-- end of scores -->"


class OnnxModel:
    """An exported model in ONNX Runtime, fed with training samples."""

    def __init__(self, path: Path, threads: int = 2) -> None:
        options = onnxruntime.SessionOptions()
        options.intra_op_num_threads = threads
        options.add_session_config_entry("session.intra_op.allow_spinning", "0")
        self.path = path
        self.session = onnxruntime.InferenceSession(str(path), options, providers=["CPUExecutionProvider"])
        self.properties = dict(self.session.get_modelmeta().custom_metadata_map)
        self.size = int(self.properties["input_size"])
        self.promising = self.properties["classes"].split(",").index("promising")
        self.threshold = float(self.properties["threshold"])

    def probability(self, image: torch.Tensor) -> np.ndarray:
        """(3, S, S) uint8 → (S, S) float32, probability of the promising class."""
        (scores,) = self.session.run(["probability"], {"image": image.numpy()[None]})
        return scores[0, self.promising]


def evaluate(model: OnnxModel, store: MazeStore, levels: list[int], mazes: int, split: str = "test") -> Scores:
    """Scores on ``mazes`` different mazes of each level, half of them drawn with one map pixel a block."""
    dataset = MazeDataset(store, split, levels, model.size, mazes * len(levels), in_turn=True)
    metrics = RegionMetrics(levels)
    for i in track(range(len(dataset)), description=f"{model.path.name}: {len(levels)} levels × {mazes} mazes"):
        sample = dataset[i]
        region = torch.from_numpy(model.probability(sample["image"]) >= model.threshold)
        metrics.update(region[None], sample["label"][None], sample["ends"][None], torch.tensor([sample["level"]]))
    return metrics.compute()


def metric_by_threshold(
    model: OnnxModel, store: MazeStore, levels: list[int], mazes: int, thresholds: list[float]
) -> list[float]:
    """The paper's metric on the evaluation split for each threshold, mean over maps; lower is better."""
    dataset = MazeDataset(store, "evaluation", levels, model.size, mazes * len(levels), in_turn=True)
    sums = np.zeros(len(thresholds))
    for i in track(range(len(dataset)), description=f"{model.path.name}: {len(thresholds)} thresholds"):
        sample = dataset[i]
        probability = model.probability(sample["image"])
        regions = torch.from_numpy(np.stack([probability >= t for t in thresholds]))
        labels = sample["label"].expand(len(thresholds), -1, -1)
        sums += (1 - accuracy(regions, labels) + redundancy(regions, labels)).numpy()
    return [float(value) for value in sums / len(dataset)]


def write_threshold(path: Path, threshold: float) -> None:
    """Sets the threshold in a model's metadata; the file is replaced as a whole."""
    graph = onnx.load(path)
    properties = {entry.key: entry.value for entry in graph.metadata_props}
    onnx.helper.set_model_props(graph, {**properties, "threshold": f"{threshold:g}"})
    temporary = path.with_name(f".{path.name}.part")
    onnx.save(graph, temporary)
    os.replace(temporary, path)


def rich_table(title: str, scores: Scores) -> Table:
    """Scores for the terminal."""
    table = Table(title=title)
    for column in ("blocks", "accuracy", "redundancy", "metric", "connected", "mazes"):
        table.add_column(column, justify="right")
    for level, row in scores.items():
        if level == "all":
            table.add_section()
        table.add_row(str(level), *_cells(row))
    return table


def markdown_table(scores: Scores) -> str:
    """Scores for the model card."""
    lines = ["| blocks | accuracy | redundancy | metric | connected | mazes |", "|---:|---:|---:|---:|---:|---:|"]
    lines += [f"| {level} | {' | '.join(_cells(row))} |" for level, row in scores.items()]
    return "\n".join(lines)


def _cells(row: dict[str, float]) -> list[str]:
    figures = [f"{row[name]:.3f}" for name in ("accuracy", "redundancy", "metric")]
    return [*figures, f"{100 * row['connectivity']:.1f} %", f"{int(row['count'])}"]


def _write(path: Path, text: str) -> None:
    temporary = path.with_name(f".{path.name}.part")
    temporary.write_text(text)
    os.replace(temporary, path)


def write_manifest(folder: Path, model: OnnxModel, scores: Scores, split: str) -> None:
    """Enters a model into ``folder``/manifest.json: hash, size, what the file says of itself, scores."""
    path = folder / "manifest.json"
    manifest: dict[str, Any] = json.loads(path.read_text()) if path.exists() else {"models": {}}
    content = model.path.read_bytes()
    manifest["models"][model.path.name] = {
        "sha256": hashlib.sha256(content).hexdigest(),
        "bytes": len(content),
        **{key: model.properties[key] for key in ("name", "input_size", "training_data", "training_budget", "commit")},
        "parameters": int(sum(np.prod(t.dims) for t in onnx.load(model.path).graph.initializer)),
        "split": split,
        "scores": {str(level): row for level, row in scores.items()},
    }
    _write(path, json.dumps(manifest, indent=1) + "\n")


def write_card_table(card: Path, scores: Scores) -> None:
    """Replaces the table between the two marks of a model card.

    Raises:
        ValueError: the card lacks the marks.
    """
    head, begin, rest = card.read_text().partition(CARD_BEGIN)
    _, end, tail = rest.partition(CARD_END)
    if not (begin and end):
        raise ValueError(f"{card}: expected the lines '{CARD_BEGIN}' and '{CARD_END}' around the table")
    _write(card, f"{head}{CARD_BEGIN}\n{markdown_table(scores)}\n{CARD_END}{tail}")


def contact_sheet(model: OnnxModel, store: MazeStore, levels: list[int], path: Path, columns: int = 4) -> None:
    """Predictions on test mazes as one picture: a row per level; colours show what was found, missed and too much."""
    dataset = MazeDataset(store, "test", levels, model.size, columns * len(levels), in_turn=True)
    figure = Figure(figsize=(2.6 * columns, 2.75 * len(levels)), layout="constrained")
    axes = figure.subplots(len(levels), columns, squeeze=False)
    for i in range(len(dataset)):
        sample = dataset[i]
        region = model.probability(sample["image"]) >= model.threshold
        picture = sample["image"].numpy().transpose(1, 2, 0).copy()
        truth, free = sample["label"].numpy() == 2, sample["label"].numpy() != 1
        plain = free & (sample["ends"].numpy() == 0)
        picture[plain & region & truth] = (60, 180, 75)
        picture[plain & region & ~truth] = (255, 200, 60)
        picture[plain & ~region & truth] = (230, 50, 160)
        ax = axes[i % len(levels)][i // len(levels)]
        ax.imshow(picture, interpolation="nearest")
        ax.set_axis_off()
        if i // len(levels) == 0:
            ax.set_title(f"{sample['level']} blocks", loc="left", fontsize=9)
    figure.suptitle("green: path found   magenta: path missed   yellow: more than the path", fontsize=10)
    figure.savefig(path, dpi=110)
