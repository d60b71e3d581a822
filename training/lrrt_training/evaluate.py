# SPDX-License-Identifier: BSD-3-Clause
"""Scores of an exported model on held-out maps, and where they are shown: manifest, card table, contact sheet.

Models are run as users run them: by the library, from the map to the region in map pixels.
"""

from __future__ import annotations

import hashlib
import json
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import onnx
import torch
from matplotlib.figure import Figure
from rich.progress import track
from rich.table import Table

import lrrt

from .export import properties_of, save_onnx
from .metrics import OBSTACLE, PROMISING, RegionMetrics, metric
from .scenes import MazeScene, Scene
from .store import SPLITS, write_text

Groups = dict[str, Callable[..., Scene]]
Scores = dict[str, dict[str, float]]
CARD_MARKS = ("<!-- scores: written by the evaluate command -->", "<!-- end of scores -->")


def scene_of(groups: Groups, group: str, number: int, split: str) -> Scene:
    """Scene ``number`` of a group; it hangs on group, number and split alone."""
    rng = np.random.default_rng([7, SPLITS.index(split), zlib.crc32(group.encode()), number])
    return groups[group](rng, number)


class Judged:
    """One prediction beside the truth, both in map pixels. How wide the true region is outside mazes goes with the
    picture that the network saw, as in training."""

    def __init__(self, predictor: lrrt.OnnxPredictor, scene: Scene) -> None:
        grid, info = scene.occupancy_map(), predictor.info
        encoder = lrrt.Encoder(info.input_size, smaller=info.smaller_inputs, least_passage=info.least_passage)
        scale = encoder.encode(grid, scene.start, scene.goal).scale
        self.scene = scene
        self.region = predictor.predict(grid, scene.start, scene.goal)
        self.label = scene.label(scale)

    def by_threshold(self, threshold: float) -> np.ndarray:
        """(H, W) bool, what the network alone marks: no link, no part dropped."""
        return (self.region.probability >= threshold) & (self.label != OBSTACLE)


def evaluate(
    predictor: lrrt.OnnxPredictor, groups: Groups, maps: int, split: str = "test", raw: bool = False
) -> Scores:
    """Scores on ``maps`` scenes of each group: of the library's regions, or with ``raw`` of the threshold alone.

    Mazes are also counted by kind, over all levels: in a perfect one there is one way, in a looped one several compete.
    """
    metrics, kinds = RegionMetrics(list(groups)), RegionMetrics(["perfect mazes", "looped mazes"])
    jobs = [(group, number) for group in groups for number in range(maps)]
    for group, number in track(jobs, description=f"{predictor.info.name}: {len(groups)} groups × {maps} maps"):
        judged = Judged(predictor, scene_of(groups, group, number, split))
        linked = judged.region.link_area > 0
        mask = judged.by_threshold(predictor.info.threshold) if raw else judged.region.mask.copy()
        joined = judged.region.connected and not (raw and linked)
        region, label = torch.from_numpy(mask), torch.from_numpy(judged.label)
        metrics.update(region[None], label[None], [group], [joined], [joined and linked])
        if isinstance(judged.scene, MazeScene):
            kind = kinds.groups[judged.scene.looped]
            kinds.update(region[None], label[None], [kind], [joined], [joined and linked])
    scores, by_kind = metrics.compute(), kinds.compute()
    of_all = scores.pop("all")
    del by_kind["all"]
    return {**scores, **by_kind, "all": of_all}


def metric_by_threshold(
    predictor: lrrt.OnnxPredictor, groups: Groups, maps: int, thresholds: list[float]
) -> list[tuple[float, float]]:
    """The paper's metric and the connectivity on the evaluation split for each threshold, means over the maps."""
    sums = np.zeros((len(thresholds), 2))
    jobs = [(group, number) for group in groups for number in range(maps)]
    for group, number in track(jobs, description=f"{predictor.info.name}: {len(thresholds)} thresholds"):
        judged = Judged(predictor, scene_of(groups, group, number, "evaluation"))
        regions = torch.from_numpy(np.stack([judged.by_threshold(t) for t in thresholds]))
        labels = torch.from_numpy(judged.label).expand(len(thresholds), -1, -1)
        sums[:, 0] += metric(regions, labels).numpy()
        grid = judged.scene.occupancy_map()
        for k, t in enumerate(thresholds):
            again = lrrt.PromisingRegion.from_array(
                grid, judged.region.probability, judged.scene.start, judged.scene.goal, threshold=t
            )
            sums[k, 1] += again.connected
    return [(float(m), float(c)) for m, c in sums / len(jobs)]


def best_threshold(thresholds: list[float], rows: list[tuple[float, float]]) -> float:
    """The threshold with the lowest metric among the rows of metric_by_threshold()."""
    return thresholds[min(range(len(rows)), key=lambda k: rows[k][0])]


def write_threshold(path: Path, threshold: float) -> None:
    """Sets the threshold in a model's metadata; the file is replaced as a whole."""
    save_onnx(onnx.load(path), path, {**properties_of(path), "threshold": f"{threshold:g}"})


def rich_table(title: str, scores: Scores) -> Table:
    """Scores for the terminal."""
    table = Table(title=title)
    for column in ("maps", "accuracy", "redundancy", "metric", "connected", "by a link", "count"):
        table.add_column(column, justify="right")
    for level, row in scores.items():
        if level == "perfect mazes" or level == "all":
            table.add_section()
        table.add_row(str(level), *_cells(row))
    return table


def markdown_table(scores: Scores) -> str:
    """Scores for the model card."""
    lines = [
        "| maps | accuracy | redundancy | metric | connected | by a link | count |",
        "|---:|---:|---:|---:|---:|---:|---:|",
    ]
    lines += [f"| {level} | {' | '.join(_cells(row))} |" for level, row in scores.items()]
    return "\n".join(lines)


def _cells(row: dict[str, float]) -> list[str]:
    figures = [f"{row[name]:.3f}" for name in ("accuracy", "redundancy", "metric")]
    return [*figures, f"{100 * row['connectivity']:.1f} %", f"{100 * row['linked']:.1f} %", f"{int(row['count'])}"]


def write_manifest(folder: Path, path: Path, scores: Scores, split: str) -> None:
    """Enters a model into ``folder``/manifest.json: hash, size, what the file says of itself, scores."""
    manifest_path = folder / "manifest.json"
    manifest: dict[str, Any] = json.loads(manifest_path.read_text()) if manifest_path.exists() else {"models": {}}
    content, properties = path.read_bytes(), properties_of(path)
    kept = (
        "name",
        "input_size",
        "smaller_inputs",
        "threshold",
        "training_data",
        "training_budget",
        "training_config",
        "commit",
    )
    manifest["models"][path.name] = {
        "sha256": hashlib.sha256(content).hexdigest(),
        "bytes": len(content),
        **{key: properties[key] for key in kept if key in properties},
        "split": split,
        "scores": {group: {k: round(v, 4) for k, v in row.items()} for group, row in scores.items()},
    }
    write_text(manifest_path, json.dumps(manifest, indent=1) + "\n")


def split_at_marks(page: Path, marks: tuple[str, str] = CARD_MARKS) -> tuple[str, str]:
    """What stands before and after the two marks around the table of a page.

    Raises:
        ValueError: there is no such page, or it lacks the marks.
    """
    begin, end = marks
    head, found, rest = page.read_text().partition(begin) if page.exists() else ("", "", "")
    _, ended, tail = rest.partition(end)
    if not (found and ended):
        raise ValueError(f"{page}: expected the lines '{begin}' and '{end}' around the table")
    return head, tail


def write_between_marks(page: Path, table: str, marks: tuple[str, str] = CARD_MARKS) -> None:
    """Replaces the table between the two marks of a page.

    Raises:
        ValueError: see split_at_marks().
    """
    head, tail = split_at_marks(page, marks)
    write_text(page, f"{head}{marks[0]}\n{table}\n{marks[1]}{tail}")


def worst_cases(
    predictor: lrrt.OnnxPredictor, groups: Groups, maps: int, columns: int = 6, split: str = "test"
) -> dict[str, list[int]]:
    """The numbers of the scenes of each group whose regions are worst: those that join nothing, then by metric."""
    worst = {}
    for group in track(groups, description=f"{predictor.info.name}: worst of {maps}"):

        def badness(number: int, group: str = group) -> tuple[bool, float]:
            judged = Judged(predictor, scene_of(groups, group, number, split))
            region, label = torch.from_numpy(judged.region.mask.copy())[None], torch.from_numpy(judged.label)[None]
            return not judged.region.connected, float(metric(region, label))

        worst[group] = sorted(range(maps), key=badness, reverse=True)[:columns]
    return worst


def contact_sheet(
    predictor: lrrt.OnnxPredictor,
    groups: Groups,
    path: Path,
    columns: int = 6,
    split: str = "test",
    numbers: dict[str, list[int]] | None = None,
) -> None:
    """Predictions as one picture: a row per group; colours show what was found, missed and too much.

    ``numbers`` chooses the scenes of each group; without it they are the first ones.
    """
    figure = Figure(figsize=(2.2 * columns, 2.35 * len(groups)), layout="constrained")
    axes = figure.subplots(len(groups), columns, squeeze=False)
    for row, group in zip(axes, groups):
        chosen = numbers[group] if numbers else range(columns)
        for place, (number, ax) in enumerate(zip(chosen, row)):
            judged = Judged(predictor, scene_of(groups, group, number, split))
            ax.imshow(verdict_picture(judged), interpolation="nearest")
            ax.plot(*judged.scene.start, "o", color="red", markersize=4, markeredgecolor="white", markeredgewidth=0.6)
            ax.plot(*judged.scene.goal, "o", color="blue", markersize=4, markeredgecolor="white", markeredgewidth=0.6)
            ax.set_axis_off()
            joined = "joined" if judged.region.connected else "broken"
            ax.set_title(f"{group}: {joined}" if place == 0 else joined, loc="left", fontsize=8)
    figure.suptitle("green: path found   magenta: path missed   yellow: more than the path", fontsize=10)
    figure.savefig(path, dpi=90)


def verdict_picture(judged: Judged) -> np.ndarray:
    """(H, W, 3) uint8: green where the region holds the path, magenta where it misses it, yellow where it is more."""
    truth, free = judged.label == PROMISING, judged.label != OBSTACLE
    mask = judged.region.mask
    picture = np.where(free, 255, 0).astype(np.uint8)[..., None].repeat(3, axis=2)
    picture[free & mask & truth] = (60, 180, 75)
    picture[free & mask & ~truth] = (255, 200, 60)
    picture[free & ~mask & truth] = (230, 50, 160)
    return picture
