# SPDX-License-Identifier: BSD-3-Clause
"""What people look at: draw(), the demo, the examples."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import lrrt
from lrrt import demo

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("[0-9]*.py"))


def labels(axes) -> list[str]:
    artists = [*axes.images, *axes.collections, *axes.lines]
    return sorted(artist.get_label() for artist in artists)


def test_draw_shows_what_it_is_given(hall):
    result = lrrt.plan(hall, (10.5, 35.5), (55.5, 5.5), keep_tree=True)
    assert labels(lrrt.draw(hall)) == ["map"]
    assert labels(lrrt.draw(hall, start=(1, 1))) == ["map", "start"]
    assert labels(lrrt.draw(hall, region=result.region)) == ["map", "region"]
    assert labels(lrrt.draw(hall, result=result)) == ["goal", "map", "path", "region", "start", "tree"]


def test_draw_refuses_a_region_of_another_map(hall):
    region = lrrt.plan(hall, (10.5, 35.5), (55.5, 5.5)).region
    with pytest.raises(lrrt.RequestError, match="expected 9×7"):
        lrrt.draw(lrrt.OccupancyMap.from_array(np.zeros((7, 9), bool)), region=region)


def test_draw_uses_map_units():
    m = lrrt.OccupancyMap.from_array(np.zeros((20, 40), bool), resolution=0.5, origin=(-3.0, 7.0, 0.0))
    axes = lrrt.draw(m)
    assert axes.get_xlim() == (-3.0, 17.0) and axes.get_ylim() == (7.0, 17.0)
    pixels = lrrt.draw(lrrt.OccupancyMap.from_array(np.zeros((20, 40), bool)))
    assert pixels.get_ylim() == (20.0, 0.0)


def test_draw_into_given_axes_and_save(hall, tmp_path):
    from matplotlib.figure import Figure

    axes = Figure().subplots()
    assert lrrt.draw(hall, ax=axes) is axes
    axes.figure.savefig(tmp_path / "map.png")
    assert np.asarray(Image.open(tmp_path / "map.png")).std() > 5


def test_the_demo_draws_four_panels_and_prints_the_figures(tmp_path, capsys):
    demo.demo(tmp_path / "demo.png", time_limit=0.5)
    width, height = Image.open(tmp_path / "demo.png").size
    assert width > 3 * height
    printed = capsys.readouterr().out
    assert "RRT*" in printed and "L-RRT*" in printed and "iterations" in printed


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_examples_run(example, tmp_path):
    output = tmp_path / "out.png"
    run = subprocess.run([sys.executable, example, output], cwd=tmp_path, capture_output=True, text=True, timeout=150)
    assert run.returncode == 0, run.stderr
    assert Image.open(output).size[0] > 100


def test_there_are_examples():
    assert len(EXAMPLES) >= 3
