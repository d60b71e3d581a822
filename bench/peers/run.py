# SPDX-License-Identifier: BSD-3-Clause
"""Planners of the PyPI package ompl, outside this project's C++, on the queries of lrrt_bench:

lrrt_bench --suite paper --problems queries
pip install 'ompl>=2.0,<3'
python bench/peers/run.py queries --json peers.json
lrrt report ours.json peers.json --output report.html
"""

from __future__ import annotations

import os
import shlex
import sys
from enum import Enum
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from lrrt import Error
from peers import campaign, tables
from peers.planners import PEERS
from peers.problems import Problems, read_problems
from peers.results import ResultFile

EXIT_BAD_INPUT = 2
EXIT_INTERRUPTED = 130

Kind = Enum("Kind", {kind: kind for kind in PEERS}, type=str)
Stop = Enum("Stop", {word: word for word in ("first", "limit")}, type=str)

_WIDE = 150  # columns of a table that goes into a file or a pipe

screen, aside = Console(), Console(stderr=True)
if not screen.is_terminal:
    screen.width = _WIDE
app = typer.Typer(add_completion=False, rich_markup_mode=None)


@app.command()
def main(
    folder: Annotated[Path, typer.Argument(metavar="FOLDER", help="That lrrt_bench --problems FOLDER wrote.")],
    json_file: Annotated[Path, typer.Option("--json", metavar="F", help="The result; F.part until it is complete.")],
    planner: Annotated[list[Kind] | None, typer.Option(help="Only this one; may be given again.")] = None,
    runs: Annotated[int | None, typer.Option(min=1, help="Seeds a query; the suite's by default.")] = None,
    seed: Annotated[int | None, typer.Option(min=0, help="The first seed; the suite's by default.")] = None,
    time_limit: Annotated[float | None, typer.Option(min=1e-3, help="Seconds a search; the suite's default.")] = None,
    stop: Annotated[Stop | None, typer.Option(help="At the first path, or at the limit; the suite's default.")] = None,
) -> None:
    """Run planners of the PyPI package ompl on the queries of lrrt_bench.

    Motions are checked as exactly as lrrt's, in Python; what that costs is measured and told apart. Ctrl-C loses
    nothing: the same command goes on. Exit codes: 0 done, 2 bad input, 130 interrupted.
    """
    kinds = tuple(dict.fromkeys(kind.value for kind in planner)) if planner else tuple(PEERS)
    wishes = campaign.Wishes(kinds, runs, seed, time_limit, stop.value if stop else None)
    try:
        _run(read_problems(folder), wishes, json_file)
    except Error as error:
        typer.echo(f"error: {error}", err=True)
        raise typer.Exit(EXIT_BAD_INPUT) from error
    except KeyboardInterrupt as interrupt:
        typer.echo(f"interrupted; finished rows are in {json_file}.part, the same command goes on", err=True)
        raise typer.Exit(EXIT_INTERRUPTED) from interrupt


def _run(problems: Problems, wishes: campaign.Wishes, json_file: Path) -> None:
    version = campaign.wheel_version()
    tasks = campaign.tasks_of(problems, wishes, version)
    header = campaign.header_of(problems, wishes, version)
    load = os.getloadavg()[0]
    if load > 0.5 * (os.cpu_count() or 1):
        aside.print(f"note: the machine is busy (load {load:.1f}): times will be long and unsteady", highlight=False)
    header["callback_overhead_us"] = campaign.measured_overheads()
    header["command"] = _command(problems, wishes, json_file)
    results = ResultFile(json_file, header)
    if len(results):
        aside.print(f"going on: {len(results)} rows are there already", highlight=False)
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=aside, transient=True, disable=not aside.is_terminal) as progress:
        bar = progress.add_task("searches", total=len(tasks))
        campaign.run_tasks(
            tasks, results, lambda task: progress.update(bar, advance=1, description=f"{task.problem.map}, {task.name}")
        )
    document = results.finish([task.id for task in tasks])
    screen.print(f"{header['suite']['title']}\nOMPL {header['versions']['ompl']}\n", highlight=False, markup=False)
    for table in tables.group_tables(document):
        screen.print(table, "", highlight=False)
    for line in tables.notes(document):
        screen.print(line, highlight=False, markup=False)


def _command(problems: Problems, wishes: campaign.Wishes, json_file: Path) -> str:
    """The command that makes the result again, with names instead of this machine's paths."""
    words = ["python", "bench/peers/run.py", problems.folder.resolve().name, "--json", json_file.name]
    if wishes.planners != tuple(PEERS):
        words += [word for kind in wishes.planners for word in ("--planner", kind)]
    options = {"--runs": wishes.runs, "--seed": wishes.seed, "--time-limit": wishes.time_limit, "--stop": wishes.stop}
    words += [str(word) for option, value in options.items() if value is not None for word in (option, value)]
    return shlex.join(words)


if __name__ == "__main__":
    app()
