# SPDX-License-Identifier: BSD-3-Clause
from __future__ import annotations

import signal
import threading

import numpy as np
import oracle
import pytest

import lrrt


def rooms() -> np.ndarray:
    occupied = np.zeros((60, 90), dtype=bool)
    occupied[:, 45] = True
    occupied[40:46, 45] = False
    return occupied


@pytest.fixture
def session() -> lrrt.Session:
    map_ = lrrt.OccupancyMap.from_array(rooms())
    return lrrt.Session(map_, strategy="uniform", planner="RRTConnect", seed=3)


def test_plans_as_plan_does(session: lrrt.Session) -> None:
    alone = lrrt.plan(session.map, (5.5, 5.5), (80.5, 5.5), strategy="uniform", planner="RRTConnect", seed=3)
    assert np.array_equal(session.plan((5.5, 5.5), (80.5, 5.5)).path, alone.path)


def test_many_queries_are_answered_in_their_order(session: lrrt.Session) -> None:
    results = session.plan_many(
        [((5.5, 5.5), (80.5, 5.5)), ((5.5, 5.5), (45.5, 5.5)), ((1.5, 1.5), (9.5, 9.5), 0.0, 0.0)]
    )
    assert [result.status for result in results] == ["solved", "goal_occupied", "solved"]
    assert np.allclose(results[2].path[-1], (9.5, 9.5))
    assert session.plan_many([]) == []


def test_guided_queries_share_the_network() -> None:
    map_ = lrrt.OccupancyMap.from_array(rooms())
    session = lrrt.Session(map_)
    results = session.plan_many([((5.5, 5.5), (80.5, 5.5)), ((80.5, 50.5), (5.5, 5.5))])
    assert all(result.solved and result.region is not None for result in results)


def test_replanning_keeps_the_path_and_goes_around_what_stands_on_it(session: lrrt.Session) -> None:
    first = session.plan((5.5, 5.5), (80.5, 5.5))
    again = session.replan((5.5, 5.5))
    assert again.reused == 1.0
    assert np.array_equal(again.path, first.path)

    occupied = rooms()
    middle = first.path[0] + 0.5 * (first.path[1] - first.path[0])
    column, row = int(middle[0]), int(middle[1])
    occupied[row - 1 : row + 2, column - 1 : column + 2] = True
    session.update(lrrt.OccupancyMap.from_array(occupied))
    assert np.array_equal(session.map.cells != 0, occupied)
    around = session.replan((5.5, 5.5))
    assert around.solved and 0.0 < around.reused < 1.0
    assert oracle.first_collision(~occupied, around.path) is None
    assert around.cost == pytest.approx(oracle.length(around.path))


def test_a_part_of_the_map_is_enough(session: lrrt.Session) -> None:
    part = session.map.cropped(44, 38, 4, 10)
    closed = np.zeros((60, 90), dtype=bool)
    session.plan((5.5, 5.5), (80.5, 5.5))
    session.update(part)  # nothing changed
    assert session.replan((5.5, 5.5)).reused == 1.0
    closed[:, 45] = True
    session.update(lrrt.OccupancyMap.from_array(closed))
    assert session.replan((5.5, 5.5)).status == "not_connected"


def test_what_it_cannot_do_is_refused(session: lrrt.Session) -> None:
    with pytest.raises(lrrt.RequestError, match="plan"):
        session.replan((1.0, 1.0))
    with pytest.raises(lrrt.MapError, match="grid"):
        session.update(lrrt.OccupancyMap.from_array(rooms(), resolution=0.5))
    with pytest.raises(TypeError):
        lrrt.Session(session.map, strategy="uniform", colour="red")
    with pytest.raises(lrrt.RequestError, match="alpha"):
        lrrt.Session(session.map, strategy="uniform", alpha=2.0)


@pytest.mark.parametrize(
    ("query", "text"),
    [
        (((1, 2),), "expected \\(start, goal\\)"),
        (5, "expected"),
        (((1, 2), "x"), "goal is"),
        (((1, 1), (9e9, 9e99 * 1e300)), "goal"),
    ],
)
def test_many_queries_are_refused_by_number(session: lrrt.Session, query, text) -> None:
    with pytest.raises(lrrt.RequestError, match=rf"^queries\[1\].*{text}"):
        session.plan_many([((2.5, 2.5), (3.5, 3.5)), query])


def test_ctrl_c_ends_a_long_query() -> None:
    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # where a shell had it ignored
    map_ = lrrt.OccupancyMap.from_array(rooms())
    session = lrrt.Session(map_, strategy="uniform", stop="limit", time_limit=60.0)
    timer = threading.Timer(0.2, signal.raise_signal, [signal.SIGINT])
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            session.plan((5.5, 5.5), (80.5, 5.5))
    finally:
        signal.signal(signal.SIGINT, before)
