# SPDX-License-Identifier: BSD-3-Clause
"""The main job on one page: ``python -m lrrt.demo`` plans in a hard maze with and without guidance, and draws it."""

from __future__ import annotations

from dataclasses import dataclass
from importlib.resources import as_file, files
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

from lrrt._core import OccupancyMap, PlanResult, PromisingRegion
from lrrt.drawing import draw
from lrrt.maps import read_map
from lrrt.planning import Point, default_predictor, plan

ALPHA = 0.8
RANGE = 6.0  # pixels, as in the paper
SEED = 1
START = (10.5, 10.5)  # first block of the maze; blocks are 7 pixels wide
GOAL = (234.5, 234.5)  # last block


@dataclass
class Contender:
    """One planner and what it did."""

    name: str
    result: PlanResult
    milliseconds: float  #: planning, and prediction where there is one


def sample_map() -> OccupancyMap:
    """The maze that ships with the package: 35×35 blocks of 7×7 pixels."""
    with as_file(files("lrrt") / "data" / "maze35.png") as path:
        return read_map(path)


def race(map_: OccupancyMap, start: Point, goal: Point, time_limit: float, console: Console) -> list[Contender]:
    """RRT* and L-RRT* on the same query with the same settings; each stops at its first path."""
    contenders = []
    for name, strategy in (("RRT*", "uniform"), (f"L-RRT*, α = {ALPHA}", "frontier")):
        with console.status(f"{name} is planning (up to {time_limit:g} s) …"):
            result = plan(
                map_,
                start,
                goal,
                planner="RRTstar",
                strategy=strategy,
                alpha=ALPHA,
                range=RANGE,
                time_limit=time_limit,
                seed=SEED,
                keep_tree=True,
            )
        contenders.append(Contender(name, result, result.timings["total"]))
    return contenders


def table(contenders: list[Contender]) -> Table:
    """The figures for the terminal."""
    result = Table(title="First path in the sample maze (time counts the prediction)")
    result.add_column("planner")
    for column in ("status", "iterations", "nodes", "time", "cost"):
        result.add_column(column, justify="right")
    for contender in contenders:
        r = contender.result
        cost = f"{r.cost:.0f} px" if r.solved else "-"
        result.add_row(
            contender.name, r.status, f"{r.iterations:,d}", f"{r.nodes:,d}", f"{contender.milliseconds:,.0f} ms", cost
        )
    return result


def picture(
    map_: OccupancyMap, start: Point, goal: Point, region: PromisingRegion, contenders: list[Contender], path: Path
) -> None:
    """Four panels: the map, the region, the two trees."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(20, 5.6), layout="constrained")
    axes = list(figure.subplots(1, 2 + len(contenders)))
    draw(map_, start=start, goal=goal, ax=axes[0]).set_title("map, start (red), goal (blue)")
    joined = "joins start and goal" if region.connected else "has gaps, which the planner bridges"
    draw(map_, region=region, start=start, goal=goal, ax=axes[1]).set_title(f"predicted region: {joined}")
    for ax, contender in zip(axes[2:], contenders):
        r = contender.result
        draw(map_, result=r, start=start, goal=goal, ax=ax)
        effort = f"{contender.name}: {r.iterations:,d} iterations, {r.nodes:,d} nodes"
        outcome = f"cost {r.cost:.0f} px" if r.solved else r.status
        ax.set_title(f"{effort}\n{contender.milliseconds:,.0f} ms, {outcome}")
    for ax in axes:
        ax.set_axis_off()
    temporary = path.with_name(f".{path.name}.part")
    figure.savefig(temporary, dpi=90, format=path.suffix.lstrip(".") or "png", bbox_inches="tight")
    temporary.replace(path)


def demo(
    output: Annotated[Path, typer.Option(help="Picture to write.")] = Path("demo.png"),
    time_limit: Annotated[float, typer.Option(metavar="SECONDS", help="Longest search of each planner.")] = 60.0,
) -> None:
    """Plan in a hard maze with RRT* and with L-RRT*; write one picture and print the same as a table."""
    console = Console()
    map_ = sample_map()
    region = default_predictor().predict(map_, START, GOAL)
    contenders = race(map_, START, GOAL, time_limit, console)
    console.print(table(contenders))
    picture(map_, START, GOAL, region, contenders, output)
    console.print(f"Picture: {output}")


if __name__ == "__main__":
    typer.run(demo)
