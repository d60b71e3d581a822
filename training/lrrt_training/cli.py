# SPDX-License-Identifier: BSD-3-Clause
"""Command line: generate, train, export, evaluate."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from .mazes import check_level
from .store import MazeStore, check_split

if TYPE_CHECKING:
    import lrrt

DATA = Path("data_cache")
EXTERNAL = Path("../../shared/maps")
MODEL = Path("../models/default.onnx")
PAGE = Path("../docs/prediction.md")
CALIBRATION_PICTURES = 128  #: training pictures that show the quantizer the range of the activations

app = typer.Typer(
    no_args_is_help=True,
    add_completion=False,
    help="Trains the network that marks promising regions.\n\nA whole run: train --config configs/fast.yaml, "
    "then export runs/fast, then evaluate ../models/default.onnx --record.",
)


@app.command(context_settings={"allow_extra_args": True, "ignore_unknown_options": True})
def train(
    context: typer.Context,
    config: Annotated[Path, typer.Option(help="YAML file, see configs/.", exists=True, dir_okay=False)],
) -> None:
    """Train, or go on with an interrupted run: the same command does both.

    Further options go to LightningCLI: --trainer.devices 2, --data.workers 4, --name trial …
    """
    from lightning.pytorch.utilities import rank_zero_only

    from .train import CheckpointError
    from .train import train as run

    try:
        folder = run(["--config", str(config), *context.args])
        rank_zero_only(typer.echo)(f"trained: {folder}")
    except (FileNotFoundError, CheckpointError) as error:
        raise typer.BadParameter(str(error)) from error
    except KeyboardInterrupt as stop:
        typer.echo(str(stop) or "interrupted; the same command goes on", err=True)
        raise typer.Exit(130) from None


@app.command()
def generate(
    data: Annotated[Path, typer.Option(help="Folder of the mazes.")] = DATA,
    levels: Annotated[str, typer.Option(help="Levels, e.g. 21-49 or 21,35.")] = "21-49",
    workers: Annotated[int, typer.Option(help="Processes, without --ray.")] = 2,
    ray: Annotated[
        str | None,
        typer.Option(
            metavar="ADDRESS",
            help="Share the work with Ray: local (this machine), auto (the cluster that this machine is part of), or "
            "HOST:PORT. Every machine needs this package; the files are written here and are the same.",
        ),
    ] = None,
) -> None:
    """Make the mazes of all splits that are missing (8000 a level: 6000 train, 1000 evaluation, 1000 test)."""
    from lrrt.sweep import ClusterError

    try:
        made = MazeStore(data).generate(_levels(levels), workers=workers, ray=ray)
    except ClusterError as error:
        raise typer.BadParameter(str(error)) from error
    typer.echo(f"{data}: {made} new files")


@app.command()
def export(
    run: Annotated[Path, typer.Argument(help="Folder of a run.", exists=True, file_okay=False)],
    output: Annotated[Path, typer.Option(help="ONNX file to write (fp32).")] = MODEL,
    int8: Annotated[bool, typer.Option(help="Quantize to int8 instead, calibrated on training pictures.")] = False,
    torchscript: Annotated[bool, typer.Option(help="Also write a TorchScript archive (.pt) beside it.")] = False,
    size: Annotated[int, typer.Option(help="Side of the network's input, pixels; 0: those of the last stage.")] = 0,
    training_data: Annotated[str, typer.Option(help="For the metadata: what it was trained on.")] = "",
    training_budget: Annotated[str, typer.Option(help="For the metadata: how long, on what.")] = "",
) -> None:
    """Export a run to ONNX and compare the file with PyTorch."""
    from . import export as files
    from .train import CheckpointError, load_data, load_network

    try:
        network, training = load_network(run), load_data(run)
    except (FileNotFoundError, CheckpointError) as error:
        raise typer.BadParameter(str(error)) from error
    stage = training.curriculum.stages[-1]
    *smaller, size = [size] if size else sorted(set(stage.sizes))
    for side in (*smaller, size):
        if side % network.stride:
            raise typer.BadParameter(f"side {side}: expected a multiple of {network.stride} for this network")
    output.parent.mkdir(parents=True, exist_ok=True)
    properties = files.metadata(
        output.stem,
        size,
        network.classes,
        training_data,
        training_budget,
        run.name,
        smaller=smaller,
        least_passage=stage.least_block,
    )
    training.prepare_data()
    images = [picture for side in [size, *smaller] for picture in training.pictures(CALIBRATION_PICTURES, side)]
    shown = images[::CALIBRATION_PICTURES] + images[1:4]
    fp32 = output.with_suffix(".fp32.onnx") if int8 else output
    try:
        files.export_onnx(network, fp32, size, properties)
        worst = _report(files.parity(network, fp32, shown), fp32)
        if torchscript:
            archive = output.with_suffix(".pt")
            files.export_torchscript(network, archive, size, properties)
            worst = max(worst, _report(files.parity(network, archive, shown), archive))
        if int8:
            files.export_int8(fp32, output, images)
            _report(files.parity(network, output, shown), output)
    finally:
        if int8:
            fp32.unlink(missing_ok=True)
    if worst > files.TOLERANCE:
        raise typer.Exit(1)


def _report(difference: float, path: Path) -> float:
    typer.echo(f"{path}: {path.stat().st_size / 1e6:.1f} MB, largest difference to PyTorch {difference:.1e}")
    return difference


@app.command()
def calibrate(
    model: Annotated[Path, typer.Argument(help="ONNX file; its threshold is set.", exists=True, dir_okay=False)],
    levels: Annotated[str, typer.Option(help="Levels, e.g. 21-49 or 21,35.")] = "21-49",
    maps: Annotated[int, typer.Option(help="Maps a group, of the evaluation split.", min=1)] = 20,
    families: Annotated[bool, typer.Option(help="Also the families and external maps.")] = False,
    data: Annotated[Path, typer.Option(help="Folder of the mazes.")] = DATA,
    external: Annotated[Path, typer.Option(help="Folder of maps of other sources.")] = EXTERNAL,
) -> None:
    """Choose the probability from which a pixel is promising: the lowest metric on the evaluation split."""
    from . import evaluate as scoring

    predictor = _predictor(model)
    groups = _groups(data, external, "evaluation", _levels(levels), families, predictor.info.input_size)
    thresholds = [round(0.05 * k, 2) for k in range(2, 18)]
    rows = scoring.metric_by_threshold(predictor, groups, maps, thresholds)
    for threshold, (metric, connected) in zip(thresholds, rows):
        typer.echo(f"threshold {threshold:.2f}  metric {metric:.4f}  connected {100 * connected:.1f} %")
    best = scoring.best_threshold(thresholds, rows)
    scoring.write_threshold(model, best)
    typer.echo(f"{model}: threshold {best:g}")


@app.command()
def evaluate(
    model: Annotated[Path, typer.Argument(help="ONNX file.", exists=True, dir_okay=False)] = MODEL,
    levels: Annotated[str, typer.Option(help="Levels, e.g. 21-49 or 21,35.")] = "21-49",
    maps: Annotated[int, typer.Option(help="Maps a group.", min=1)] = 200,
    families: Annotated[bool, typer.Option(help="Also the families and external maps.")] = True,
    split: Annotated[str, typer.Option(help="train, evaluation or test.")] = "test",
    data: Annotated[Path, typer.Option(help="Folder of the mazes.")] = DATA,
    external: Annotated[Path, typer.Option(help="Folder of maps of other sources.")] = EXTERNAL,
    threads: Annotated[int, typer.Option(help="Threads of ONNX Runtime.")] = 2,
    raw: Annotated[bool, typer.Option(help="Score what the threshold alone marks: no link, no part dropped.")] = False,
    record: Annotated[bool, typer.Option(help="Write the scores to manifest.json and the model card.")] = False,
    sheet: Annotated[Path | None, typer.Option(help="Also write a contact sheet of predictions (PNG).")] = None,
    failures: Annotated[Path | None, typer.Option(help="Also write one of the worst predictions (PNG).")] = None,
) -> None:
    """Score an exported model on held-out maps, as users run it: by the library, in map pixels."""
    from rich.console import Console

    from . import evaluate as scoring

    predictor = _predictor(model, threads)
    if record and raw:
        raise typer.BadParameter("--record --raw: only the scores of what users get are recorded")
    if record:
        try:
            scoring.split_at_marks(model.parent / "README.md")
        except ValueError as error:
            raise typer.BadParameter(f"--record: {error}") from error
    groups = _groups(data, external, split, _levels(levels), families, predictor.info.input_size)
    scores = scoring.evaluate(predictor, groups, maps, split, raw)
    Console().print(scoring.rich_table(f"{model.name}, {split} maps", scores))
    if record:
        scoring.write_manifest(model.parent, model, scores, split)
        scoring.write_between_marks(model.parent / "README.md", scoring.markdown_table(scores))
    if sheet is not None:
        scoring.contact_sheet(predictor, groups, sheet, split=split)
    if failures is not None:
        worst = scoring.worst_cases(predictor, groups, maps, split=split)
        scoring.contact_sheet(predictor, groups, failures, split=split, numbers=worst)


@app.command()
def study(
    runs: Annotated[list[Path], typer.Argument(help="Folders of the runs to compare.", exists=True, file_okay=False)],
    levels: Annotated[str, typer.Option(help="Levels, e.g. 21-49 or 21,35.")] = "21-49",
    maps: Annotated[int, typer.Option(help="Test maps a level.", min=1)] = 1000,
    page: Annotated[Path, typer.Option(help="Page that receives the table; the figure goes beside it.")] = PAGE,
    data: Annotated[Path, typer.Option(help="Folder of the mazes.")] = DATA,
) -> None:
    """The paper's study: accuracy, redundancy and connectivity of several networks against the maze level."""
    from . import evaluate as scoring
    from . import study as studies

    chosen = _levels(levels)
    try:
        scoring.split_at_marks(page, studies.MARKS)
        results = {run.name: studies.scores_of(run, MazeStore(data), chosen, maps) for run in runs}
    except (FileNotFoundError, ValueError) as error:
        raise typer.BadParameter(str(error)) from error
    studies.write(page, results)
    typer.echo(f"{page}: {len(results)} networks, {len(chosen)} levels, {maps} maps each")


def _predictor(model: Path, threads: int = 0) -> lrrt.OnnxPredictor:
    import lrrt

    try:
        return lrrt.OnnxPredictor(model, threads=threads)
    except lrrt.ModelError as error:
        raise typer.BadParameter(str(error)) from error


def _groups(data: Path, external: Path, split: str, levels: list[int], families: bool, size: int) -> dict:
    """The groups of scenes to score, their mazes generated where they are missing."""
    from .families.external import ExternalMaps
    from .scenes import SceneSource

    try:
        check_split(split)
        outside = ExternalMaps(external)
    except ValueError as error:
        raise typer.BadParameter(str(error)) from error
    store = MazeStore(data)
    store.generate(levels, (split,))
    groups = SceneSource(store, outside, split).groups(levels, size)
    return groups if families else {str(level): groups[str(level)] for level in levels}


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
