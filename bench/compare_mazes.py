# SPDX-License-Identifier: BSD-3-Clause
"""L-RRT* against RRT* on mazes, as in the paper: same mazes, same seeds, same settings, only the sampler differs.

    .venv/bin/python bench/compare_mazes.py --level 35 --mazes 50

The mazes are perfect ones of the training package's test split, drawn on 256×256 pixels;
start and goal are the two ends of the longest path. Every planner stops at its first path.
The time of L-RRT* counts the prediction.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import statistics
import time
from collections import deque
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.progress import track
from rich.table import Table

import lrrt
from lrrt_training import mazes

PICTURE_SIDE = 256
PLANNERS = {  # strategy, and what finds near nodes: RRT* as OMPL ships it comes first, the others are told against it
    "RRT*": ("uniform", "ompl"),
    "RRT*, our neighbours": ("uniform", "grid"),
    "L-RRT*, region": ("region", "grid"),
    "L-RRT*, frontier": ("frontier", "grid"),
}
TEST_SPLIT = 2  # the training package numbers its splits: train 0, evaluation 1, test 2


@dataclass
class Run:
    """One plan of one planner."""

    planner: str
    maze: int
    seed: int
    solved: bool
    iterations: int
    nodes: int
    milliseconds: float
    cost: float


def farthest(blocks: np.ndarray, origin: tuple[int, int]) -> tuple[int, int]:
    """The free block with the longest way from ``origin`` (breadth-first search)."""
    seen = {origin}
    queue = deque([origin])
    last = origin
    while queue:
        last = queue.popleft()
        for dr, dc in ((0, 1), (1, 0), (0, -1), (-1, 0)):
            block = (last[0] + dr, last[1] + dc)
            if block not in seen and not blocks[block]:
                seen.add(block)
                queue.append(block)
    return last


def problem(level: int, index: int) -> tuple[lrrt.OccupancyMap, tuple[float, float], tuple[float, float]]:
    """Maze ``index`` of a level as a picture, and the ends of its longest path in pixels."""
    rng = np.random.default_rng([1, TEST_SPLIT, level, index])
    blocks = mazes.perfect_maze(rng, level, mazes.ALGORITHMS[index % len(mazes.ALGORITHMS)])
    side = PICTURE_SIDE // level
    picture = np.ones((PICTURE_SIDE, PICTURE_SIDE), dtype=bool)
    margin = (PICTURE_SIDE - level * side) // 2
    picture[margin : margin + level * side, margin : margin + level * side] = np.kron(
        blocks, np.ones((side, side), bool)
    )
    start = farthest(blocks, (1, 1))  # in a tree the farthest block from anywhere is an end of the longest path
    goal = farthest(blocks, start)
    to_pixels = [(margin + (c + 0.5) * side, margin + (r + 0.5) * side) for r, c in (start, goal)]
    return lrrt.OccupancyMap.from_array(picture), to_pixels[0], to_pixels[1]


def run(name: str, maze: int, level: int, predictor: lrrt.OnnxPredictor, args: argparse.Namespace) -> Run:
    """One plan; the seed is the maze's number."""
    strategy, neighbors = PLANNERS[name]
    guided = strategy != "uniform"
    map_, start, goal = problem(level, maze)
    result = lrrt.plan(
        map_,
        start,
        goal,
        planner="RRTstar",
        strategy=strategy,
        alpha=args.alpha,
        predictor=predictor if guided else None,
        stop="first",
        range=args.range,
        time_limit=args.time_limit,
        neighbors=neighbors,
        seed=maze + 1,
    )
    return Run(
        name,
        maze,
        maze + 1,
        result.solved,
        result.iterations,
        result.nodes,
        result.timings["total"],
        float(result.cost),
    )


def table(runs: list[Run], title: str) -> Table:
    """Median, mean and standard deviation of each figure for each planner, then the ratio maze by maze."""
    figures = ("iterations", "nodes", "milliseconds", "cost")
    result = Table(title=title)
    for column in ("planner", "solved", *(f"{f}: median (mean ± sd)" for f in figures)):
        result.add_column(column, justify="left" if column == "planner" else "right")
    by_name = {name: [r for r in runs if r.planner == name] for name in dict.fromkeys(r.planner for r in runs)}
    for name, rows in by_name.items():
        cells = []
        for figure in figures:
            values = [getattr(r, figure) for r in rows if r.solved]
            if len(values) < 2:
                cells.append("-")
                continue
            median, mean, deviation = statistics.median(values), statistics.mean(values), statistics.stdev(values)
            cells.append(f"{median:,.0f} ({mean:,.0f} ± {deviation:,.0f})")
        result.add_row(name, f"{sum(r.solved for r in rows)}/{len(rows)}", *cells)
    result.add_section()
    plain, *others = by_name
    for name in others:
        pairs = [(a, b) for a, b in zip(by_name[plain], by_name[name]) if a.solved and b.solved]
        ratios = [statistics.median(getattr(a, f) / getattr(b, f) for a, b in pairs) for f in figures] if pairs else []
        result.add_row(f"{plain} / {name}", str(len(pairs)), *(f"median {r:.2f}×" for r in ratios))
    return result


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--level", type=int, default=35, help="blocks a side (odd)")
    parser.add_argument("--mazes", type=int, default=50, help="number of mazes")
    parser.add_argument("--alpha", type=float, default=0.8, help="share of samples from the region")
    parser.add_argument("--range", type=float, default=6.0, help="longest extension of the tree, pixels")
    parser.add_argument("--time-limit", type=float, default=120.0, help="seconds for one plan")
    parser.add_argument("--model", type=Path, help="ONNX model (default: the one that ships)")
    parser.add_argument("--json", type=Path, help="write every run to this file")
    args = parser.parse_args()

    predictor = lrrt.OnnxPredictor(args.model)
    runs: list[Run] = []
    connected = 0
    for maze in track(range(args.mazes), description=f"{args.level}×{args.level} mazes"):
        map_, start, goal = problem(args.level, maze)
        connected += predictor.predict(map_, start, goal).connected
        runs += [run(name, maze, args.level, predictor, args) for name in PLANNERS]
    console = Console(width=150)
    mazes_text = f"{args.mazes} perfect mazes of {args.level}×{args.level} blocks, 256×256 pixels"
    console.print(table(runs, f"First path in {mazes_text}, α = {args.alpha:g}"))
    console.print(f"The predicted region joins start and goal by itself in {connected} of {args.mazes} mazes.")
    console.print(f"{os.cpu_count()} cores, {platform.machine()}")
    if args.json:
        record = {
            "arguments": {k: str(v) for k, v in vars(args).items()},
            "model": str(predictor.info.path),
            "time": time.time(),
        }
        temporary = args.json.with_suffix(".part")
        temporary.write_text(json.dumps({**record, "runs": [asdict(r) for r in runs]}, indent=1))
        temporary.replace(args.json)


if __name__ == "__main__":
    main()
