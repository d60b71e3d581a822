# SPDX-License-Identifier: BSD-3-Clause
"""Command line: generate, train, export, evaluate."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .mazes import check_level
from .store import MazeStore, check_split

DATA = Path("data_cache")
MODEL = Path("../models/default.onnx")

app = typer.Typer(
    no_args_is_help=True,
    add_completion=False,
    help="Trains the network that marks promising regions.\n\nA whole run: train --config configs/default.yaml, "
    "then export runs/default, then evaluate ../models/default.onnx --record.",
)


@app.command()
def train(
    config: Annotated[Path, typer.Option(help="YAML file, see configs/.", exists=True, dir_okay=False)],
    minutes: Annotated[float, typer.Option(help="Longest time of each stage; 0 leaves the file's.")] = 0.0,
) -> None:
    """Train, or go on with an interrupted run: the same command does both."""
    from jsonargparse import ArgumentParser

    from .train import TrainConfig
    from .train import train as run

    parser = ArgumentParser()
    parser.add_class_arguments(TrainConfig, None)
    values = parser.instantiate(parser.parse_path(str(config)))
    settings = TrainConfig(**vars(values))
    if minutes > 0:
        for stage in settings.stages:
            stage.minutes = minutes
    try:
        typer.echo(f"trained: {run(settings)}")
    except KeyboardInterrupt as stop:
        typer.echo(str(stop) or "interrupted; the same command goes on", err=True)
        raise typer.Exit(130) from None


@app.command()
def generate(
    data: Annotated[Path, typer.Option(help="Folder of the mazes.")] = DATA,
    levels: Annotated[str, typer.Option(help="Levels, e.g. 21-49 or 21,35.")] = "21-49",
    workers: Annotated[int, typer.Option(help="Processes.")] = 2,
) -> None:
    """Make the mazes of all splits that are missing (8000 a level: 6000 train, 1000 evaluation, 1000 test)."""
    made = MazeStore(data).generate(_levels(levels), workers=workers)
    typer.echo(f"{data}: {made} new files")


@app.command()
def export(
    run: Annotated[Path, typer.Argument(help="Folder of a run (its last stage is taken) or a checkpoint.")],
    output: Annotated[Path, typer.Option(help="ONNX file to write.")] = MODEL,
    size: Annotated[int, typer.Option(help="Side of the network's input, pixels.")] = 256,
    training_data: Annotated[str, typer.Option(help="For the metadata: what it was trained on.")] = "",
    training_budget: Annotated[str, typer.Option(help="For the metadata: how long, on what.")] = "",
) -> None:
    """Export a checkpoint to ONNX and compare the file with PyTorch."""
    import torch

    from .export import TOLERANCE, export_onnx, metadata, parity
    from .train import load_module

    module = load_module(_last_checkpoint(run))
    output.parent.mkdir(parents=True, exist_ok=True)
    properties = metadata(output.stem, size, module.hparams.classes, training_data, training_budget)
    export_onnx(module.network, output, size, properties)
    difference = parity(module.network, output, torch.randint(0, 256, (2, 3, size, size), dtype=torch.uint8))
    typer.echo(f"{output}: {output.stat().st_size / 1e6:.1f} MB, largest difference to PyTorch {difference:.1e}")
    if difference > TOLERANCE:
        raise typer.Exit(1)


@app.command()
def calibrate(
    model: Annotated[Path, typer.Argument(help="ONNX file; its threshold is set.", exists=True, dir_okay=False)],
    levels: Annotated[str, typer.Option(help="Levels, e.g. 21-49 or 21,35.")] = "21-49",
    mazes: Annotated[int, typer.Option(help="Mazes a level, of the evaluation split.")] = 20,
    data: Annotated[Path, typer.Option(help="Folder of the mazes.")] = DATA,
) -> None:
    """Choose the probability from which a pixel is promising: the lowest metric on the evaluation split."""
    from . import evaluate as scoring

    store = MazeStore(data)
    wanted = _levels(levels)
    store.generate(wanted, ("evaluation",))
    thresholds = [round(0.05 * k, 2) for k in range(6, 20)]
    metrics = scoring.metric_by_threshold(scoring.OnnxModel(model), store, wanted, mazes, thresholds)
    for threshold, metric in zip(thresholds, metrics):
        typer.echo(f"threshold {threshold:.2f}  metric {metric:.4f}")
    best = thresholds[metrics.index(min(metrics))]
    scoring.write_threshold(model, best)
    typer.echo(f"{model}: threshold {best:g}")


@app.command()
def evaluate(
    model: Annotated[Path, typer.Argument(help="ONNX file.", exists=True, dir_okay=False)] = MODEL,
    levels: Annotated[str, typer.Option(help="Levels, e.g. 21-49 or 21,35.")] = "21,25,31,35,45,49",
    mazes: Annotated[int, typer.Option(help="Mazes a level.")] = 200,
    split: Annotated[str, typer.Option(help="train, evaluation or test.")] = "test",
    data: Annotated[Path, typer.Option(help="Folder of the mazes.")] = DATA,
    threads: Annotated[int, typer.Option(help="Threads of ONNX Runtime.")] = 2,
    record: Annotated[bool, typer.Option(help="Write the scores to manifest.json and the model card.")] = False,
    sheet: Annotated[Path | None, typer.Option(help="Also write a contact sheet of predictions (PNG).")] = None,
) -> None:
    """Score an exported model on held-out mazes."""
    from rich.console import Console

    from . import evaluate as scoring

    store = MazeStore(data)
    wanted = _levels(levels)
    try:
        check_split(split)
    except ValueError as error:
        raise typer.BadParameter(str(error)) from error
    store.generate(wanted, (split,))
    loaded = scoring.OnnxModel(model, threads)
    scores = scoring.evaluate(loaded, store, wanted, mazes, split)
    Console().print(scoring.rich_table(f"{model.name}, {split} mazes", scores))
    if record:
        scoring.write_manifest(model.parent, loaded, scores, split)
        scoring.write_card_table(model.parent / "README.md", scores)
    if sheet is not None:
        scoring.contact_sheet(loaded, store, wanted, sheet)


def _last_checkpoint(run: Path) -> Path:
    """The checkpoint of the last stage in the folder of a run; a file is taken as it is."""
    if run.is_file():
        return run
    checkpoints = sorted(run.glob("stage*.ckpt"), key=lambda path: int(path.stem.removeprefix("stage")))
    if not checkpoints:
        raise typer.BadParameter(f"{run}: no checkpoint (stage1.ckpt …) there; train first")
    return checkpoints[-1]


def _levels(text: str) -> list[int]:
    """ "21-25,31" → [21, 23, 25, 31]."""
    levels: list[int] = []
    try:
        for part in text.split(","):
            low, dash, high = part.partition("-")
            check_level(int(low))
            levels += range(int(low), int(high if dash else low) + 1, 2)
    except ValueError as error:
        raise typer.BadParameter(f"{text!r}: expected odd levels such as 21-49 or 21,35") from error
    if not levels:
        raise typer.BadParameter(f"{text!r}: no level lies in it; expected levels such as 21-49 or 21,35")
    return levels


def main() -> None:
    """Entry point of the command line."""
    app()
