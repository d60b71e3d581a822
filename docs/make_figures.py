# SPDX-License-Identifier: BSD-3-Clause
"""Draws docs/guidance.png: how trees grow with and without guidance.

.venv/bin/python docs/make_figures.py
"""

from __future__ import annotations

from pathlib import Path

from matplotlib.figure import Figure

import lrrt
from lrrt import demo

ITERATIONS = (100, 400, 1600)


def main() -> None:
    map_ = demo.sample_map()
    region = lrrt.default_predictor().predict(map_, demo.START, demo.GOAL)
    strategies = ("uniform", "region", "frontier")
    figure = Figure(figsize=(4 * len(ITERATIONS), 4.2 * len(strategies)), layout="constrained")
    for row, strategy in zip(figure.subplots(len(strategies), len(ITERATIONS)), strategies):
        for ax, iterations in zip(row, ITERATIONS):
            result = lrrt.plan(
                map_,
                demo.START,
                demo.GOAL,
                strategy=strategy,
                alpha=demo.ALPHA,
                range=demo.RANGE,
                seed=demo.SEED,
                iteration_limit=iterations,
                time_limit=60.0,
                keep_tree=True,
            )
            shown = None if strategy == "uniform" else region
            lrrt.draw(map_, region=shown, result=result, start=demo.START, goal=demo.GOAL, ax=ax)
            outcome = "first path" if result.solved else "no path yet"
            ax.set_title(f"{strategy}: {result.iterations:,d} iterations, {outcome}", fontsize=10)
            ax.set_axis_off()
    target = Path(__file__).with_name("guidance.png")
    temporary = target.with_suffix(".part")
    figure.savefig(temporary, dpi=70, format="png")
    temporary.replace(target)
    print(target)


if __name__ == "__main__":
    main()
