# SPDX-License-Identifier: BSD-3-Clause
"""What the wheel's planners call in Python, every call timed; ``python -m peers.callbacks`` says what calls cost."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Callable
from time import perf_counter
from typing import Any

import numpy as np
from ompl import base as ob

from peers.validity import SegmentCheck

Check = Callable[[float, float, float, float], bool]

_CALLS, _ROUNDS = 500, 300  # of which the quickest counts: short ones are less likely to be interrupted


class Watch:
    """What the callbacks of a search share: its clock, what they took, and the paths that were seen."""

    def __init__(self, seconds: float = math.inf) -> None:
        self.begin = perf_counter()
        self.deadline = self.begin + seconds
        self.seconds = 0.0  #: inside callbacks
        self.motions = 0
        self.states = 0
        self.stops = 0  #: questions whether to stop: the iterations, as lrrt counts them
        self.best = math.inf
        self.history: list[list[float]] = []

    def restart(self, seconds: float) -> None:
        """Forgets everything and starts the clock."""
        self.__dict__.update(Watch(seconds).__dict__)

    def note(self, now: float, cost: float) -> None:
        """Keeps a shorter path: when it was seen, how long it is, and what callbacks took until then."""
        self.best = cost
        self.history.append([1e3 * (now - self.begin), self.stops, cost, *self.spent()])

    def spent(self) -> list[float]:
        """Milliseconds inside callbacks, and how often they were called: motions, states, questions."""
        return [1e3 * self.seconds, self.motions, self.states, self.stops]


class ExactMotions(ob.MotionValidator):
    """Tells a planner which motions are free."""

    def __init__(self, space: ob.SpaceInformation, is_free: Check, watch: Watch) -> None:
        super().__init__(space)
        self._is_free = is_free
        self._watch = watch

    def checkMotion(self, start: Any, end: Any) -> bool:  # noqa: N802 - OMPL's name
        """Whether a straight motion is free; none is once time is up, so that no iteration outlives it."""
        begin = perf_counter()
        watch = self._watch
        watch.motions += 1
        free = begin < watch.deadline and self._is_free(start[0], start[1], end[0], end[1])
        watch.seconds += perf_counter() - begin
        return free


class _UntimedMotions(ob.MotionValidator):
    """The same without the clock, to measure what the clock costs."""

    def __init__(self, space: ob.SpaceInformation, is_free: Check) -> None:
        super().__init__(space)
        self._is_free = is_free

    def checkMotion(self, start: Any, end: Any) -> bool:  # noqa: N802 - OMPL's name
        return self._is_free(start[0], start[1], end[0], end[1])


def state_question(check: SegmentCheck, watch: Watch) -> Callable[[Any], bool]:
    """A function that tells whether a state is free."""

    def is_valid(state: Any) -> bool:
        begin = perf_counter()
        watch.states += 1
        free = check.is_free_point(state[0], state[1])
        watch.seconds += perf_counter() - begin
        return free

    return is_valid


def stop_question(watch: Watch, best_cost: Callable[[], Any] | None, at_first: bool) -> Callable[[], bool]:
    """A function that tells whether to stop.

    Args:
        watch: knows when time is up.
        best_cost: the planner's, asked for shorter paths: the wheel cannot call back when it finds one.
        at_first: whether a path ends the search.
    """

    def stops() -> bool:
        begin = perf_counter()
        watch.stops += 1
        if best_cost is not None:
            cost = best_cost().value()
            if cost < watch.best:
                watch.note(begin, cost)
        over = begin >= watch.deadline or (at_first and watch.best < math.inf)
        watch.seconds += perf_counter() - begin
        return over

    return stops


def plane(width: int, height: int) -> ob.SpaceInformation:
    """The plane over a map of so many pixels."""
    space = ob.RealVectorStateSpace(2)
    bounds = ob.RealVectorBounds(2)
    for axis, side in enumerate((width, height)):
        bounds.setLow(axis, 0.0)
        bounds.setHigh(axis, side)
    space.setBounds(bounds)
    return ob.SpaceInformation(space)


def overheads() -> dict[str, float]:
    """Microseconds of one call that the clock inside it does not see: C++ to Python and back, and reading the clock.

    For motions, states and questions whether to stop; and ``timing``, what measuring adds to a motion altogether.
    """

    def free(*_: float) -> bool:
        return True

    watch, check = Watch(), SegmentCheck(np.ones((9, 9), dtype=bool))
    space, untimed = plane(9, 9), plane(9, 9)
    motions, untimed_motions = ExactMotions(space, free, watch), _UntimedMotions(untimed, free)
    space.setMotionValidator(motions)
    untimed.setMotionValidator(untimed_motions)
    space.setStateValidityChecker(state_question(check, watch))
    condition = ob.PlannerTerminationCondition(stop_question(watch, None, False))
    a, b = space.allocState(), space.allocState()
    a[0], a[1], b[0], b[1] = 1.5, 1.5, 2.5, 2.5
    # Calling from Python costs too, unlike a planner's call: it is taken off, measured with functions of pure C++.
    two_states, one_state = _per_call(watch, space.distance, a, b), _per_call(watch, space.satisfiesBounds, a)
    motion = _per_call(watch, space.checkMotion, a, b)
    return {
        "motion": motion[0] - motion[1] - two_states[0],
        "state": (state := _per_call(watch, space.isValid, a))[0] - state[1] - one_state[0],
        "stop": (stop := _per_call(watch, condition.eval))[0] - stop[1] - one_state[0],
        "timing": motion[0] - _per_call(watch, untimed.checkMotion, a, b)[0],
    }


def _per_call(watch: Watch, call: Callable[..., Any], *arguments: Any) -> tuple[float, float]:
    """Microseconds of one call, and how much of it the clock inside saw."""
    best = (math.inf, 0.0)
    for _ in range(_ROUNDS):
        watch.restart(math.inf)
        for _ in range(_CALLS):
            call(*arguments)
        whole = perf_counter() - watch.begin
        best = min(best, (1e6 * whole / _CALLS, 1e6 * watch.seconds / _CALLS))
    return best


if __name__ == "__main__":
    print(json.dumps(overheads()), flush=True)
    os._exit(0)  # see search.py
