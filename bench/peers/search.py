# SPDX-License-Identifier: BSD-3-Clause
"""One search by one planner of the wheel, in a process of its own: a job comes in, an answer goes out, both as JSON.

    cd bench && echo '{"picture": "/…/map_1.png", …}' | python -m peers.search

Processes of their own, so that a crash ends one search and not the campaign. lrrt is not imported here: it brings an
OMPL of its own.
"""

from __future__ import annotations

import gc
import json
import math
import os
import sys
from dataclasses import dataclass, replace
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np
import numpy.typing as npt
from ompl import base as ob
from ompl import geometric as og
from ompl import util as ou

from peers.callbacks import ExactMotions, Watch, plane, state_question, stop_question
from peers.planners import PEERS, Peer
from peers.validity import SegmentCheck, read_free

_WARM_UP = 0.05  # seconds
_HAIR = 1e-9  # pixels; rounding


@dataclass(frozen=True)
class Job:
    """What to search. Points and lengths are pixels (x right, y down)."""

    picture: str
    start: tuple[float, float]
    goal: tuple[float, float]
    planner: str  #: one of PEERS
    range: float
    goal_bias: float
    goal_tolerance: float
    stop: str  #: first or limit
    time_limit: float  #: seconds
    seed: int


def definition(space: ob.SpaceInformation, job: Job) -> ob.ProblemDefinition:
    """Start, goal, and how short a path ends the search: any path, or none."""
    ends = []
    for point in (job.start, job.goal):
        state = space.allocState()
        state[0], state[1] = point
        ends.append(state)
    problem = ob.ProblemDefinition(space)
    problem.setStartAndGoalStates(*ends, max(job.goal_tolerance, sys.float_info.epsilon))
    objective = ob.PathLengthOptimizationObjective(space)
    objective.setCostThreshold(ob.Cost(math.inf if job.stop == "first" else 0.0))
    problem.setOptimizationObjective(objective)
    return problem


def planner_of(peer: Peer, space: ob.SpaceInformation, problem: ob.ProblemDefinition, job: Job) -> ob.Planner:
    """The planner, set as lrrt sets its own."""
    planner = getattr(og, peer.kind)(space)
    if peer.has_range:
        planner.setRange(job.range)
    if peer.has_goal_bias:
        planner.setGoalBias(job.goal_bias)
    if peer.is_rrt_star:
        planner.setKNearest(False)
    planner.setProblemDefinition(problem)
    planner.setup()
    return planner


def refusal(check: SegmentCheck, job: Job) -> str | None:
    """Why there is nothing to search, as one of lrrt's statuses."""
    for end, point in (("start", job.start), ("goal", job.goal)):
        if not check.is_inside(*point):
            return f"{end}_outside"
        if not check.is_free_point(*point):
            return f"{end}_occupied"
    return None


def search(job: Job, free: npt.NDArray[np.bool_]) -> dict[str, Any]:
    """Runs a job on a map. Lengths in the answer are pixels, times milliseconds."""
    ou.RNG.setSeed(max(1, job.seed))  # OMPL refuses 0
    begin = perf_counter()
    check, watch, peer = SegmentCheck(free), Watch(), PEERS[job.planner]
    refused = refusal(check, job)
    if refused is not None:
        return {"status": refused, "prepare_ms": 1e3 * (perf_counter() - begin)}
    space = plane(free.shape[1], free.shape[0])
    motions = ExactMotions(space, check.is_free, watch)  # has a name, so that it lives as long as the planner
    space.setMotionValidator(motions)
    space.setStateValidityChecker(state_question(check, watch))
    space.setup()
    problem = definition(space, job)
    planner = planner_of(peer, space, problem, job)
    ends_itself = not peer.shortens or (peer.heeds_threshold and job.stop == "first")
    stops = stop_question(watch, None if ends_itself else planner.bestCost, job.stop == "first")
    condition = ob.PlannerTerminationCondition(stops)
    prepare_ms = 1e3 * (perf_counter() - begin)
    watch.restart(job.time_limit)
    planner.solve(condition)
    end = perf_counter()
    answer = {"prepare_ms": prepare_ms, "plan_ms": 1e3 * (end - watch.begin), "spent": watch.spent()}
    path = path_of(problem)
    outcome = judged(path, check, watch, job, end)
    return {**answer, **outcome, "nodes": nodes_of(planner, space), "history": watch.history, "path": path}


def judged(
    path: list[tuple[float, float]], check: SegmentCheck, watch: Watch, job: Job, end: float
) -> dict[str, str | float]:
    """The status, the length of the path that the planner returned, and what is wrong with it."""
    if not path:
        return {"status": "time_limit" if end >= watch.deadline else "gave_up"}
    wrong = violations(path, check, job)
    length = sum(map(math.dist, path, path[1:]))
    if length < watch.best:
        watch.note(end, length)
    return {"status": "wrong_path" if wrong else "solved", "length": length, "violations": wrong}


def path_of(problem: ob.ProblemDefinition) -> list[tuple[float, float]]:
    """The path that is said to join start and goal; empty where there is none."""
    if not problem.hasExactSolution():
        return []
    return [(state[0], state[1]) for state in problem.getSolutionPath().getStates()]


def violations(path: list[tuple[float, float]], check: SegmentCheck, job: Job) -> int:
    """How many segments of a path are not free, and how many of its ends are not the query's."""
    blocked = sum(not check.is_free(*a, *b) for a, b in zip(path, path[1:]))
    begins = math.dist(path[0], job.start) <= _HAIR
    ends = math.dist(path[-1], job.goal) <= job.goal_tolerance + _HAIR
    return blocked + (not begins) + (not ends)


def nodes_of(planner: ob.Planner, space: ob.SpaceInformation) -> int:
    """Nodes of the planner's trees; AORRTC shows none."""
    data = ob.PlannerData(space)
    planner.getPlannerData(data)
    return int(data.numVertices())


def answer_to(job: Job, warm_up: bool = True) -> dict[str, Any]:
    """Runs a job on its picture, after a short search that is not measured.

    The first search of a process waits for memory and code; all but the first of lrrt_bench do not. OMPL warns that a
    seed set after other searches changes nothing; it does set the numbers of every planner made from then on.
    """
    free = read_free(Path(job.picture))
    if warm_up:
        search(replace(job, stop="first", time_limit=min(_WARM_UP, job.time_limit), seed=job.seed + 1), free)
    return search(job, free)


def main() -> None:
    """Reads a job, prints the answer as the last line."""
    job = Job(**json.load(sys.stdin))
    ou.setLogLevel(ou.LogLevel.LOG_NONE)
    gc.disable()  # what is made here lives until the end
    print(json.dumps(answer_to(job)), flush=True)
    os._exit(0)  # the wheel complains of leaks, and may crash, when Python takes it down


if __name__ == "__main__":
    main()
