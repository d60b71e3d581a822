# SPDX-License-Identifier: BSD-3-Clause
"""The command line: ``lrrt plan``, ``lrrt predict``, ``lrrt info``, ``lrrt report``, ``lrrt sweep``.

Exit codes: 0 done (a path was found), 2 bad input, 3 no path, 130 interrupted (``lrrt sweep``).
"""

from __future__ import annotations

import json
import math
import os
import sys
from pathlib import Path
from typing import Annotated, Any, NoReturn

import typer
from rich.console import Console
from rich.progress import MofNCompleteColumn, Progress
from rich.table import Table

from lrrt._core import Error, OccupancyMap, OnnxPredictor, PlanResult, __version__, planner_names
from lrrt.drawing import draw
from lrrt.maps import read_map_with_sources
from lrrt.outputs import check_picture, save_picture
from lrrt.planning import default_predictor, plan

EXIT_BAD_INPUT = 2
EXIT_NO_PATH = 3
EXIT_INTERRUPTED = 130

_LARGEST_SEED = 2**64 - 1

SWEEP_HELP = (
    "Share a benchmark suite between machines, with Ray.\n\n"
    "Workers run lrrt_bench on parts (shards) of the suite; FILE receives what one run of all would have written, and "
    "the same tables are printed. A shard whose worker or machine is lost is run again elsewhere. After Ctrl-C the "
    "same command goes on: finished shards lie beside FILE until it is written.\n\n"
    "Shards side by side on one machine slow each other down. Compare iterations and nodes, which stay the same "
    "unless the clock ends a search, or give each shard a machine of its own with [bold]--exclusive[/bold] "
    "where times are wanted.\n\n"
    'Every machine needs lrrt with Ray (pip install "lrrt\\[sweep]"), the same versions of Python, Ray and lrrt_bench, '
    "and lrrt_bench and the suite with its maps and models at the same paths, as in a shared folder. Relative paths "
    "count from where the command is given. Where the folder of FILE is shared, unfinished shards are gone on with, "
    "too.\n\n"
    "Example: [bold]lrrt sweep smoke --shards 4 --json smoke.json --bench build/release/bench/lrrt_bench[/bold]\n\n"
    "Example: [bold]ray start --head[/bold] on one machine, [bold]ray start --address HOST:6379[/bold] on the others, "
    "then [bold]lrrt sweep paper --ray auto --shards 60 --exclusive --json paper.json[/bold]\n\n"
    "Exit codes: 0 done, 2 bad input, 130 interrupted."
)

app = typer.Typer(
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode="rich",
    help="Plans paths on maps, guided by a network that marks where a path probably lies.\n\n"
    "Coordinates are in map units: pixels (x right, y down) for pictures and MovingAI maps, metres for ROS "
    "map_server maps.\n\n"
    "Exit codes: 0 done, 2 bad input, 3 no path.",
)


def _print_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"lrrt {__version__}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print the version and exit.")
    ] = False,
) -> None:  # what stands before the command's name
    pass


MapPath = Annotated[Path, typer.Argument(metavar="MAP", help="Picture, map_server .yaml or MovingAI .map.")]
Start = Annotated[tuple[float, float], typer.Option(metavar="X Y", help="Where the path begins.")]
Goal = Annotated[tuple[float, float], typer.Option(metavar="X Y", help="Where it ends.")]
Model = Annotated[Path | None, typer.Option(metavar="FILE", help="ONNX model; the one that ships by default.")]
Pixels = Annotated[bool, typer.Option("--pixels", help="Start and goal are pixels (x right, y down) on any map.")]
Picture = Annotated[Path | None, typer.Option(metavar="FILE", help="Draw the outcome into this .png, .pdf or .svg.")]
Json = Annotated[bool, typer.Option("--json", help="Print one JSON object instead of a table.")]


@app.command("plan")
def plan_command(
    map_path: MapPath,
    start: Start,
    goal: Goal,
    planner: Annotated[str, typer.Option(help=f"One of {', '.join(planner_names())}.")] = "RRTstar",
    strategy: Annotated[
        str, typer.Option(help="Where guided samples come from: frontier, region, uniform (unguided).")
    ] = "frontier",
    alpha: Annotated[float, typer.Option(help="Share of guided samples, 0 to 1.")] = 0.8,
    model: Model = None,
    on_predict_error: Annotated[
        str, typer.Option(help="raise, or unguided: plan without guidance where the model fails, and warn.")
    ] = "raise",
    stop: Annotated[
        str, typer.Option(help="first (path), factor (near the shortest), limit (use all the time).")
    ] = "first",
    cost_factor: Annotated[float, typer.Option(help="For --stop factor: how near to the shortest grid path.")] = 1.05,
    time_limit: Annotated[float, typer.Option(metavar="SECONDS", help="Longest search.")] = 60.0,
    reach: Annotated[float, typer.Option("--range", help="Longest extension of the tree; 0 chooses by the map.")] = 0.0,
    radius: Annotated[float, typer.Option(help="Radius of a disc-shaped robot, map units; 0 is a point.")] = 0.0,
    unknown: Annotated[str, typer.Option(help="What unknown pixels count as: occupied or free.")] = "occupied",
    seed: Annotated[int, typer.Option(min=0, max=_LARGEST_SEED, help="Same seed, same path.")] = 1,
    pixels: Pixels = False,
    as_json: Json = False,
    picture: Picture = None,
) -> None:
    """Plan a path.

    Example: [bold]lrrt plan maze.png --start 10.5 10.5 --goal 240 250 --picture plan.png[/bold]

    Example: [bold]lrrt plan office.yaml --start -1.5 2 --goal 14 9.5 --radius 0.2 --json[/bold]
    """
    try:
        map_, ends = _read(map_path, start, goal, pixels, model, picture)
        with Console(stderr=True).status(f"planning, up to {time_limit:g} s (Ctrl-C ends it) …"):
            result = plan(
                map_,
                *ends,
                planner=planner,
                strategy=strategy,
                alpha=alpha,
                model=model,
                on_predict_error=on_predict_error,
                stop=stop,
                cost_factor=cost_factor,
                time_limit=time_limit,
                range=reach,
                radius=radius,
                unknown=unknown,
                seed=seed,
                keep_tree=picture is not None,
            )
        if picture is not None:
            save_picture(draw(map_, result=result, start=ends[0], goal=ends[1]), picture)
    except Error as error:
        _fail(error)
    if result.predict_error:
        _warn(f"planned without guidance: {result.predict_error}")
    if as_json:
        typer.echo(json.dumps(result_fields(result)))
    else:
        Console().print(_result_table(map_, result))
    if not result.solved:
        raise typer.Exit(EXIT_NO_PATH)


@app.command("predict")
def predict_command(
    map_path: MapPath,
    start: Start,
    goal: Goal,
    picture: Annotated[
        Path, typer.Option(metavar="FILE", help="The map with the region in green: .png, .pdf or .svg.")
    ],
    model: Model = None,
    pixels: Pixels = False,
    as_json: Json = False,
) -> None:
    """Mark the promising region only.

    Example: [bold]lrrt predict maze.png --start 10.5 10.5 --goal 240 250 --picture region.png[/bold]
    """
    try:
        map_, ends = _read(map_path, start, goal, pixels, model, picture)
        predictor = default_predictor() if model is None else OnnxPredictor(model)
        region, timings = predictor.predict_timed(map_, *ends)
        save_picture(draw(map_, region=region, start=ends[0], goal=ends[1]), picture)
    except Error as error:
        _fail(error)
    if as_json:
        fields = {"connected": region.connected, "area": region.area, "timings": timings, "picture": str(picture)}
        typer.echo(json.dumps(fields))
        return
    table = _plain_table()
    table.add_row("connected", "yes" if region.connected else "no")
    table.add_row(
        "area",
        f"{region.area:,d} pixels, {100 * region.area / max(1, int((map_.cells == 0).sum())):.1f} % of the free ones",
    )
    table.add_row("time", _times(timings))
    table.add_row("picture", str(picture))
    Console().print(table)


@app.command("info")
def info_command(
    model: Annotated[
        Path | None, typer.Argument(metavar="[MODEL]", help="ONNX model; the one that ships by default.")
    ] = None,
    as_json: Json = False,
) -> None:
    """Tell what a model says of itself."""
    try:
        info = OnnxPredictor(model).info
    except Error as error:
        _fail(error)
    fields: dict[str, Any] = {
        "path": str(info.path),
        "name": info.name,
        "input_size": info.input_size,
        "smaller_inputs": info.smaller_inputs,
        "marker_side": info.marker_side,
        "classes": info.classes,
        "threshold": round(info.threshold, 6),
        "training_data": info.training_data,
        "training_budget": info.training_budget,
        "commit": info.commit,
        "runtime_version": info.runtime_version,
    }
    if as_json:
        typer.echo(json.dumps(fields))
        return
    table = _plain_table()
    for key, value in fields.items():
        table.add_row(key.replace("_", " "), ", ".join(map(str, value)) if isinstance(value, list) else str(value))
    Console().print(table)


@app.command("report")
def report_command(
    results: Annotated[
        list[Path], typer.Argument(metavar="RESULTS...", help="Files that lrrt_bench --json wrote, gzipped or not.")
    ],
    output: Annotated[Path, typer.Option(metavar="FILE", help="HTML file to write, complete in itself.")] = Path(
        "report.html"
    ),
    figures: Annotated[
        Path | None, typer.Option(metavar="FOLDER", help="Also write the figures, as SVG files.")
    ] = None,
    markdown: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Also write Markdown, with links to --figures.")
    ] = None,
) -> None:
    """Turn results of lrrt_bench into a page with figures and tables.

    Example: [bold]lrrt report paper.json --output paper.html[/bold]

    Example: [bold]lrrt report paper.json --figures docs/images/paper --markdown docs/paper.md[/bold]
    """
    from lrrt.report import write_report

    try:
        with Console(stderr=True).status("drawing …"):
            written = write_report(results, output, figures, markdown)
    except Error as error:
        _fail(error)
    for path in written:
        typer.echo(path)


@app.command("sweep", help=SWEEP_HELP)
def sweep_command(
    suite: Annotated[str, typer.Argument(metavar="SUITE", help="Name or .yaml file, as lrrt_bench --suite takes it.")],
    result: Annotated[Path, typer.Option("--json", metavar="FILE", help="File to write, as lrrt_bench --json does.")],
    shards: Annotated[int, typer.Option(min=1, max=999_999, metavar="N", help="Parts; several for each CPU.")],
    ray: Annotated[
        str,
        typer.Option(
            metavar="ADDRESS",
            help="local (this machine), auto (the cluster that this machine is part of), or HOST:PORT of a cluster.",
        ),
    ] = "local",
    bench: Annotated[str, typer.Option(metavar="PROGRAM", help="lrrt_bench, in PATH or with its path.")] = "lrrt_bench",
    runs: Annotated[int | None, typer.Option(min=1, metavar="N", help="Seeds a query, instead of the suite's.")] = None,
    seed: Annotated[
        int | None, typer.Option(min=0, max=_LARGEST_SEED, metavar="S", help="Seed of the first run.")
    ] = None,
    time_limit: Annotated[float | None, typer.Option(metavar="SECONDS", help="Longest search.")] = None,
    cpus: Annotated[
        int, typer.Option(min=1, metavar="N", help="CPUs that a shard reserves; guided rows use up to 2.")
    ] = 1,
    exclusive: Annotated[
        bool, typer.Option("--exclusive", help="Reserve all CPUs of a machine for a shard; --cpus is not asked.")
    ] = False,
) -> None:
    """Share a benchmark suite between machines; SWEEP_HELP says how."""
    from lrrt.report import terminal_report
    from lrrt.sweep import Sweep, finished_shards, run_sweep

    console = Console(stderr=True, soft_wrap=True, highlight=False)
    if shards > 1 and not exclusive:
        console.print("note: shards side by side share a machine: compare iterations, or give --exclusive for times")
    sweep = Sweep(suite, result, shards, bench, runs, seed, time_limit)
    columns = (*Progress.get_default_columns(), MofNCompleteColumn())
    try:
        with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as bar:
            task = bar.add_task("shards", total=shards)
            run_sweep(sweep, ray, cpus=cpus, exclusive=exclusive, progress=lambda n: bar.update(task, completed=n))
        typer.echo(terminal_report(result), nl=False)
    except Error as error:
        _fail(error)
    except KeyboardInterrupt:
        done = finished_shards(sweep)
        console.print(f"interrupted after {done} of {shards} shards; they are kept, and the same command goes on")
        raise typer.Exit(EXIT_INTERRUPTED) from None


def result_fields(result: PlanResult) -> dict[str, Any]:
    """The fields of a result as JSON knows them; a cost without a path is null."""
    region = result.region
    return {
        "status": result.status,
        "solved": result.solved,
        "path": result.path.tolist(),
        "cost": result.cost if math.isfinite(result.cost) else None,
        "iterations": result.iterations,
        "nodes": result.nodes,
        "draws": result.draws,
        "cost_history": result.cost_history.tolist(),
        "region": None
        if region is None
        else {
            "connected": region.connected,
            "area": region.area,
            "bridge_area": region.bridge_area,
            "coarseness": region.coarseness,
        },
        "predict_error": result.predict_error,
        "timings": result.timings,
    }


def _read(
    path: Path,
    start: tuple[float, float],
    goal: tuple[float, float],
    pixels: bool,
    model: Path | None,
    picture: Path | None,
) -> tuple[OccupancyMap, list[Any]]:
    """The map with start and goal in its units, once it is known that the picture may be written."""
    map_, sources = read_map_with_sources(path)
    if picture is not None:
        check_picture(picture, sources if model is None else [*sources, model])
    return map_, [map_.to_world(point) if pixels else point for point in (start, goal)]


def _fail(error: Exception) -> NoReturn:
    _say("[bold red]error:[/bold red]", str(error))
    raise typer.Exit(EXIT_BAD_INPUT) from error


def _warn(text: str) -> None:
    _say("[bold yellow]warning:[/bold yellow]", text)


def _say(kind: str, text: str) -> None:
    from rich.markup import escape

    Console(stderr=True, soft_wrap=True, highlight=False).print(f"{kind} {escape(text)}")


def _plain_table() -> Table:
    table = Table(box=None, show_header=False, padding=(0, 2, 0, 0))
    table.add_column(style="bold")
    table.add_column()
    return table


def _times(timings: dict[str, float]) -> str:
    return ", ".join(f"{name} {value:.1f}" for name, value in timings.items()) + " ms"


def _result_table(map_: OccupancyMap, result: PlanResult) -> Table:
    unit = "m" if map_.is_metric else "pixels"
    table = _plain_table()
    table.add_row("status", result.status)
    if result.solved:
        table.add_row("cost", f"{result.cost:.3f} {unit}, {len(result.path)} points")
    table.add_row("iterations", f"{result.iterations:,d}")
    table.add_row("nodes", f"{result.nodes:,d}")
    if result.region is not None:
        bridged = result.region.bridge_area
        table.add_row(
            "region",
            f"{result.region.area:,d} pixels"
            + (f" of {side}×{side} of the map's" if (side := result.region.coarseness) > 1 else "")
            + (f", {bridged:,d} of them to close gaps" if bridged else ""),
        )
    table.add_row("time", _times(result.timings))
    return table


def main() -> None:
    """Entry point of the command ``lrrt``."""
    try:
        app()
    except OSError as error:  # a reader that went away is none: that is told by the exit code alone
        if error.filename is not None:
            raise
        _say("[bold red]error:[/bold red]", f"standard output: cannot be written ({error.strerror or error})")
        # What is still held back would be written, and fail, again as Python ends.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(EXIT_BAD_INPUT)
