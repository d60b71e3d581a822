# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of maps, regions and results."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from lrrt._core import OccupancyMap, PlanResult, PromisingRegion, RequestError
from lrrt.planning import Point

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.transforms import Affine2D

_GREYS = np.array([255, 40, 205], dtype=np.uint8)  # free, occupied, unknown
_REGION = (0, 170, 70, 110)  # red, green, blue, alpha
_TREE = "#5b7fb5"
_PATH = "#f2660a"
_START = "#ff0000"
_GOAL = "#0000ff"


def draw(
    map: OccupancyMap,
    region: PromisingRegion | None = None,
    result: PlanResult | None = None,
    start: Point | None = None,
    goal: Point | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draws a map and, where given, its promising region, a result's tree and path, start and goal.

    The axes show map units: pixels with y down for pictures, metres with y up for map_server maps. No window opens;
    without ``ax`` a new figure is made: ``draw(…).figure.savefig("out.png")``.

    Args:
        map: free is white, occupied dark, unknown light grey.
        region: shown in translucent green; by default the one that ``result`` used.
        result: its tree is shown when it was made with ``keep_tree=True``.
        start: red disc; by default the first point of the result's path.
        goal: blue square; by default the last point of the result's path.
        ax: matplotlib axes to draw into.

    Raises:
        RequestError: the region is one of a map of another size.
    """
    axes = _new_axes() if ax is None else ax
    _show(axes, map, _GREYS[map.cells], "map")
    if region is None and result is not None:
        region = result.region
    if region is not None:
        _check_belongs(region, map)
        _show(axes, map, _overlay(region), "region", region.coarseness)
    if result is not None:
        _draw_tree(axes, result)
        _draw_path(axes, result)
        if result.solved:
            start = result.path[0] if start is None else start
            goal = result.path[-1] if goal is None else goal
    for point, color, marker, label in ((start, _START, "o", "start"), (goal, _GOAL, "s", "goal")):
        if point is not None:
            _draw_marker(axes, point, color, marker, label)
    _set_view(axes, map)
    return axes


def _check_belongs(region: PromisingRegion, map: OccupancyMap) -> None:
    height, width = region.mask.shape
    columns, rows = (1 + (side - 1) // region.coarseness for side in (map.width, map.height))
    if (width, height) != (columns, rows):
        raise RequestError(f"a region of {width}×{height} pixels is none of this map: expected {columns}×{rows}")


def _new_axes() -> Axes:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8, 8), layout="constrained")
    FigureCanvasAgg(figure)
    return figure.add_subplot()


def _overlay(region: PromisingRegion) -> npt.NDArray[np.uint8]:
    pixels = np.zeros((*region.mask.shape, 4), dtype=np.uint8)
    pixels[region.mask] = _REGION
    return pixels


def _pixel_to_world(map: OccupancyMap) -> Affine2D:
    """Map's own conversion, which is affine, as matplotlib knows it."""
    from matplotlib.transforms import Affine2D

    origin, right, down = (np.asarray(map.to_world(p)) for p in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0)))
    matrix = np.eye(3)
    matrix[:2] = np.column_stack((right - origin, down - origin, origin))
    return Affine2D(matrix)


def _show(axes: Axes, map: OccupancyMap, pixels: npt.NDArray[np.uint8], label: str, coarseness: int = 1) -> None:
    image = axes.imshow(
        pixels,
        cmap="gray",
        vmin=0,
        vmax=255,
        interpolation="nearest",
        extent=(0, coarseness * pixels.shape[1], coarseness * pixels.shape[0], 0),
        transform=_pixel_to_world(map) + axes.transData,
    )
    image.set_label(label)


def _draw_tree(axes: Axes, result: PlanResult) -> None:
    from matplotlib.collections import LineCollection

    edges = result.tree.reshape(-1, 2, 2)
    if len(edges):
        axes.add_collection(LineCollection(list(edges), colors=_TREE, linewidths=0.5, label="tree"), autolim=False)


def _draw_path(axes: Axes, result: PlanResult) -> None:
    if result.solved:
        axes.plot(*result.path.T, color=_PATH, linewidth=2.0, solid_joinstyle="round", label="path")


def _draw_marker(axes: Axes, point: Point, color: str, marker: str, label: str) -> None:
    x, y = point
    axes.plot(
        [x], [y], linestyle="none", marker=marker, markersize=7, color=color, markeredgecolor="white", label=label
    )


def _set_view(axes: Axes, map: OccupancyMap) -> None:
    corners = np.array([map.to_world((x, y)) for x in (0.0, map.width) for y in (0.0, map.height)])
    (left, low), (right, high) = corners.min(axis=0), corners.max(axis=0)
    axes.set_xlim(left, right)
    axes.set_ylim(*((low, high) if map.is_metric else (high, low)))
    axes.set_aspect("equal")
