# SPDX-License-Identifier: BSD-3-Clause
"""Many queries of one robot on one map, which may change a little from one to the next."""

from __future__ import annotations

import reprlib
import threading
from collections.abc import Iterable
from typing import Any

from lrrt import _core
from lrrt._core import CancelToken, OccupancyMap, PlanResult, RegionPredictor, RequestError
from lrrt.planning import Point, as_count, as_outline, as_point, choose_predictor

#: (start, goal) or (start, goal, start_heading, goal_heading)
QueryLike = tuple[Point, Point] | tuple[Point, Point, float, float]


def _asked(query: QueryLike, name: str) -> _core.Query:
    try:
        start, goal, *headings = query
        complete = len(headings) in (0, 2)
    except (TypeError, ValueError):
        complete = False
    if not complete:
        raise RequestError(
            f"{name} is {reprlib.repr(query)}: expected (start, goal) or (start, goal, start_heading, goal_heading)"
        )
    return _core.Query(as_point(start, f"{name}: start"), as_point(goal, f"{name}: goal"), *headings)


class Session:
    """Many queries of one robot on one map.

    What does not change from query to query is made once (grown obstacles, the distance field, components), and a path
    is good for more than one query: ``replan()`` keeps what is still free of it.

    >>> session = lrrt.Session(map_, planner="RRTConnect", radius=0.3)  # doctest: +SKIP
    >>> session.plan((1.0, 2.0), (14.0, 9.0))  # doctest: +SKIP
    >>> session.update(costmap)  # the map as it is now, or a part of it  # doctest: +SKIP
    >>> session.replan((1.4, 2.3))  # from where the robot is now  # doctest: +SKIP

    Args:
        map: where to plan; the session keeps a copy.
        predictor: marks the region; None takes the shipped model (see ``default_predictor``).
        options: those of ``plan()`` but for start, goal, headings and cancel token.

    Raises:
        RequestError: an option is out of its range, or the robot cannot move as asked.
        TypeError: there is no such option.
    """

    def __init__(self, map: OccupancyMap, *, predictor: RegionPredictor | None = None, **options: Any) -> None:
        if options.get("outline") is not None:
            options["outline"] = as_outline(options["outline"])
        for name in {"seed", "iteration_limit"} & options.keys():
            options[name] = None if options[name] is None else as_count(options[name], name)
        predictor = choose_predictor(
            predictor,
            options.pop("model", None),
            options.get("strategy", "frontier"),
            options.get("on_predict_error", "raise"),
        )
        self._session = _core.Session(_core.Settings(**options), predictor, map)
        self._lock = threading.Lock()

    @property
    def map(self) -> OccupancyMap:
        """The map as it is now; a copy."""
        with self._lock:
            return self._session.map

    def plan(
        self,
        start: Point,
        goal: Point,
        *,
        start_heading: float = 0.0,
        goal_heading: float = 0.0,
        cancel: CancelToken | None = None,
    ) -> PlanResult:
        """Plans as ``lrrt.plan`` does, with the same result.

        Raises:
            RequestError, ModelError: as ``lrrt.plan``.
        """
        query = _core.Query(as_point(start, "start"), as_point(goal, "goal"), start_heading, goal_heading)
        with self._lock:
            return self._session.plan([query], cancel)[0]

    def plan_many(self, queries: Iterable[QueryLike], *, cancel: CancelToken | None = None) -> list[PlanResult]:
        """Plans many queries; the network marks their regions together. The results are those of ``plan()``.

        Args:
            queries: (start, goal) or (start, goal, start_heading, goal_heading) each.
            cancel: a token that another thread may use to end the search.

        Raises:
            RequestError, ModelError: as ``lrrt.plan``, with the query's number; then there is no result.
        """
        asked = [_asked(query, f"queries[{i}]") for i, query in enumerate(queries)]
        with self._lock:
            return self._session.plan(asked, cancel)

    def replan(self, start: Point, *, heading: float = 0.0, cancel: CancelToken | None = None) -> PlanResult:
        """Plans from where the robot is now to the goal of the last query.

        Follows the last path as far as it is still free: ways to that path, and around what stands on it since, are
        planned near by and unguided. Where that fails, plans as ``plan()`` does; ``result.reused`` tells how much was
        kept. A path that became longer than it would have to be is kept, too; ``plan()`` looks anew.

        Raises:
            RequestError: there was no query yet.
        """
        with self._lock:
            return self._session.replan(as_point(start, "start"), heading, cancel)

    def update(self, part: OccupancyMap) -> None:
        """The map has changed.

        Args:
            part: the map as it is now, or a part of it: of the same resolution, its pixels on those of the map, e.g.
                one of ``OccupancyMap.cropped`` or a local costmap.

        Raises:
            MapError: the pixels do not coincide, or the part leaves the map.
        """
        with self._lock:
            self._session.update(part)
