# SPDX-License-Identifier: BSD-3-Clause
"""The one call: a map, a start and a goal in, a path out."""

from __future__ import annotations

import contextlib
import operator
import os
import reprlib
import threading
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from lrrt import _core
from lrrt._core import (
    CancelToken,
    ModelError,
    OccupancyMap,
    OnnxPredictor,
    PlanResult,
    RegionPredictor,
    RequestError,
    UnloadedPredictor,
)

Point = Sequence[float] | npt.NDArray[np.floating[Any]]  #: (x, y) in map units

_lock = threading.Lock()
_default: OnnxPredictor | None = None


def default_predictor() -> OnnxPredictor:
    """The predictor of the shipped model, loaded at the first call and shared from then on.

    Raises:
        ModelError: the model or ONNX Runtime cannot be loaded.
    """
    global _default
    with _lock:
        if _default is None:
            _default = OnnxPredictor()
        return _default


def as_point(point: Point, name: str) -> npt.NDArray[np.float64]:
    """(x, y) as the extension module takes it.

    Raises:
        RequestError: it is no pair of real numbers; the text begins with ``name``.
    """
    with contextlib.suppress(ValueError, TypeError):  # what no array can hold
        pair = np.asarray(point)
        if pair.shape == (2,) and pair.dtype.kind in "fiu":
            return pair.astype(np.float64)
    raise RequestError(f"{name} is {reprlib.repr(point)}: expected (x, y), two numbers in map units")


def as_count(value: int, name: str) -> int:
    """A number of 64 bits as the extension module takes it.

    Raises:
        RequestError: it is no whole number, or out of range; the text begins with ``name``.
    """
    with contextlib.suppress(TypeError):
        if 0 <= operator.index(value) < 1 << 64:
            return operator.index(value)
    raise RequestError(f"{name} is {reprlib.repr(value)}: expected a whole number from 0 to 2**64 - 1")


def as_outline(corners: Sequence[Point] | npt.NDArray[np.floating[Any]]) -> list[npt.NDArray[np.float64]]:
    """A robot's corners as the extension module takes them.

    Raises:
        RequestError: they are no sequence of points.
    """
    try:
        return [as_point(corner, f"outline[{i}]") for i, corner in enumerate(corners)]
    except TypeError as error:
        raise RequestError(f"outline is {reprlib.repr(corners)}: expected points (x, y) in map units") from error


def plan(
    map: OccupancyMap,
    start: Point,
    goal: Point,
    *,
    planner: str = "RRTstar",
    strategy: str = "frontier",
    alpha: float = 0.8,
    predictor: RegionPredictor | None = None,
    model: str | os.PathLike[str] | None = None,
    on_predict_error: str = "raise",
    stop: str = "first",
    cost_factor: float = 1.05,
    time_limit: float = 5.0,
    iteration_limit: int | None = None,
    range: float = 0.0,
    goal_bias: float = 0.05,
    goal_tolerance: float = 0.0,
    radius: float = 0.0,
    unknown: str = "occupied",
    seed: int = 1,
    keep_tree: bool = False,
    neighbors: str = "grid",
    cancel: CancelToken | None = None,
    outline: Sequence[Point] | npt.NDArray[np.floating[Any]] | None = None,
    motion: str = "plane",
    turning_radius: float = 0.0,
    start_heading: float = 0.0,
    goal_heading: float = 0.0,
    simplify: bool = False,
    speed: float = 0.0,
    reverse_speed: float = 0.0,
    turn_rate: float = 0.0,
    heading_tolerance: float = 0.25,
    clearance: float = 0.0,
    clearance_weight: float = 3.0,
) -> PlanResult:
    """Plans a path from start to goal, guided by the promising region that a network marks.

    Lengths and points are in map units: pixels for pictures, metres for map_server maps. A call without an answer is
    no error: ``result.status`` says why. Ctrl-C ends a search within some hundredths of a second.

    Args:
        map: where to plan.
        start: (x, y) where the path begins.
        goal: (x, y) where it ends.
        planner: one of ``planner_names()``.
        strategy: where guided samples come from: ``"frontier"`` (the region just ahead of the tree), ``"region"``
            (all of it, the paper's sampler), or ``"uniform"`` for planning without guidance.
        alpha: share of guided samples, 0 to 1; the others are uniform. 1 gives up completeness.
        predictor: marks the region; None takes ``model``.
        model: ONNX file to load for this one call; None takes the shipped model (see ``default_predictor``). For many
            calls load an ``OnnxPredictor`` once and hand it in as ``predictor``.
        on_predict_error: ``"raise"``, or ``"unguided"``: where the model cannot be loaded or its prediction fails, plan
            as with ``strategy="uniform"``; ``result.predict_error`` says why. A RequestError is raised either way.
        stop: ``"first"`` path, ``"factor"`` (cost within ``cost_factor`` of the straightened shortest grid path), or
            ``"limit"``: use all the time or iterations to shorten the path, until it is as short as any can be.
        cost_factor: for ``stop="factor"``, at least 1.
        time_limit: seconds of search; prediction is not counted.
        iteration_limit: iterations of the planner, None for no limit.
        range: longest extension of the tree; 0 chooses by the map.
        goal_bias: share of iterations that aim at the goal (RRT, RRT*).
        goal_tolerance: the path may end this far from the goal; 0 ends exactly there.
        radius: of a disc-shaped robot; 0 plans for a point. With an outline: a margin around it.
        unknown: ``"occupied"`` or ``"free"``: what unknown pixels count as.
        seed: same seed, same result, unless time ends the search.
        keep_tree: fill ``result.tree``.
        neighbors: what finds the near nodes of a tree: ``"grid"``, ours, or ``"ompl"``, what OMPL itself takes. In
            the plane a matter of time only; for ``"dubins"`` only our RRTConnect's second tree grows to the goal.
        cancel: a token that another thread may use to end the search.
        outline: corners (x, y) of the robot in its own frame, heading along +x, the reference point at the origin and
            inside; convex or concave. None for a disc or a point.
        motion: ``"plane"``, straight lines without a heading; ``"turning"``, straight lines on which the robot turns,
            also on the spot; ``"dubins"``, forwards on arcs and straight lines; ``"reeds_shepp"``, the same forwards
            and backwards. All but the plane fill ``result.headings``; the cost is then the length of the arcs and
            lines, for ``"turning"`` plus the angle turned times the distance to the robot's farthest corner.
            ``"unicycle"`` and ``"car"`` are driven by controls, which fill ``result.controls``: they need a planner of
            ``control_planner_names()``, a ``speed`` and a ``goal_tolerance``; the cost is the time that the controls
            take, seconds.
        turning_radius: the tightest one, for ``"dubins"``, ``"reeds_shepp"`` and ``"car"``.
        start_heading: radians from the map's x axis towards its y axis.
        goal_heading: the same.
        simplify: shorten the path at the end, within what is left of the time limit.
        speed: the greatest one forwards, map units per second; for ``"unicycle"`` and ``"car"``.
        reverse_speed: the greatest one backwards; 0 for a robot that only drives forwards.
        turn_rate: the greatest one, radians per second; for ``"unicycle"``.
        heading_tolerance: a unicycle or a car may end with its heading this far off ``goal_heading``, radians; pi for
            any heading. ``result.goal_distance`` and ``result.goal_turn`` tell how far off it is.
        clearance: the distance to obstacles that the path shall keep where it can; 0 for no wish. Measured from the
            robot's edge: that of its disc, or of the disc that its outline holds. What comes nearer costs more, so
            planners that shorten their path (``stop="limit"``) avoid it. Not for ``"unicycle"`` and ``"car"``.
        clearance_weight: how many times its own length a way right along an obstacle costs in addition.

    Raises:
        RequestError: an option is out of its range, a coordinate is not finite, the robot cannot move as asked, or both
            a predictor and a model are given.
        ModelError: the model cannot be loaded or fails, with ``on_predict_error="raise"``.
    """
    predictor = choose_predictor(predictor, model, strategy, on_predict_error)
    settings = _core.Settings(
        planner=planner,
        strategy=strategy,
        alpha=alpha,
        stop=stop,
        cost_factor=cost_factor,
        time_limit=time_limit,
        iteration_limit=None if iteration_limit is None else as_count(iteration_limit, "iteration_limit"),
        range=range,
        goal_bias=goal_bias,
        goal_tolerance=goal_tolerance,
        radius=radius,
        unknown=unknown,
        seed=as_count(seed, "seed"),
        keep_tree=keep_tree,
        neighbors=neighbors,
        outline=None if outline is None else as_outline(outline),
        motion=motion,
        turning_radius=turning_radius,
        simplify=simplify,
        on_predict_error=on_predict_error,
        speed=speed,
        reverse_speed=reverse_speed,
        turn_rate=turn_rate,
        heading_tolerance=heading_tolerance,
        clearance=clearance,
        clearance_weight=clearance_weight,
    )
    ends = as_point(start, "start"), as_point(goal, "goal")
    return _core.plan(settings, predictor, map, *ends, start_heading, goal_heading, cancel)


def choose_predictor(
    predictor: RegionPredictor | None, model: str | os.PathLike[str] | None, strategy: str, on_predict_error: str
) -> RegionPredictor | None:
    """What marks the region, by the options of ``plan``.

    Raises:
        RequestError: both a predictor and a model are given.
        ModelError: the model cannot be loaded, with ``on_predict_error="raise"``; else the predictor tells at its first
            prediction why it has none.
    """
    if predictor is not None and model is not None:
        raise RequestError("predictor and model are both given: expected one of them; the other marks no region")
    if predictor is not None or strategy == "uniform":
        return predictor
    try:
        return default_predictor() if model is None else OnnxPredictor(os.fspath(model))
    except ModelError as error:
        if on_predict_error != "unguided":
            raise
        return UnloadedPredictor(str(error))
