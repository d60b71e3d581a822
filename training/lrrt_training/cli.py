# SPDX-License-Identifier: BSD-3-Clause
"""Command line: generate, train, export, evaluate."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

app = typer.Typer(
    no_args_is_help=True,
    add_completion=False,
    help="Trains the network that marks promising regions.\n\nA whole run: train --config configs/default.yaml, "
    "then export runs/default, then evaluate ../models/default.onnx.",
)


@app.callback()
def _root() -> None:
    """Keeps commands named even while there is only one."""


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
    values = parser.instantiate_classes(parser.parse_path(str(config)))
    settings = TrainConfig(**vars(values))
    if minutes > 0:
        for stage in settings.stages:
            stage.minutes = minutes
    typer.echo(f"trained: {run(settings)}")


def main() -> None:
    app()
