# SPDX-License-Identifier: BSD-3-Clause
"""Properties of random queries through Python, judged by NumPy; LRRT_PROPERTY_RUNS says how many (make nightly)."""

from __future__ import annotations

import math
import os

import numpy as np
import oracle
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import lrrt

RUNS = int(os.environ.get("LRRT_PROPERTY_RUNS", "40"))
many = settings(max_examples=RUNS, print_blob=True, suppress_health_check=[HealthCheck.too_slow])
cells = st.integers(1, 40).flatmap(
    lambda width: st.integers(1, 40).flatmap(
        lambda height: st.tuples(st.just((height, width)), st.floats(0, 0.6), st.floats(0, 0.2), st.integers(0, 2**32))
    )
)
frames = st.none() | st.tuples(st.floats(1e-3, 1e3), st.floats(-1e3, 1e3), st.floats(-1e3, 1e3), st.floats(-4, 4))


def make_map(cells, frame) -> lrrt.OccupancyMap:
    """Noise in clumps: 0 free, 1 occupied, 2 unknown."""
    shape, density, unknown, seed = cells
    rng = np.random.default_rng(seed)
    coarse = rng.random((shape[0] // 3 + 1, shape[1] // 3 + 1)) < density
    array = np.kron(coarse, np.ones((3, 3)))[: shape[0], : shape[1]].astype(np.uint8)
    array[rng.random(shape) < unknown] = 2
    if frame is None:
        return lrrt.OccupancyMap.from_array(array)
    resolution, x, y, yaw = frame
    return lrrt.OccupancyMap.from_array(array, resolution=resolution, origin=(x, y, yaw))


def inflate(free: np.ndarray, radius: float) -> np.ndarray:
    """The free pixels every point of which is `radius` pixels from all that is not free, pair by pair."""
    if radius == 0:
        return free
    blocked = np.argwhere(~np.pad(free, 1)) - 1  # the ring around the map is
    result = free.copy()
    for r, c in np.argwhere(free):
        gaps = np.maximum(np.abs(blocked - (r, c)) - 1, 0)
        result[r, c] = (np.hypot(*gaps.T) >= radius).all()
    return result


@many
@given(
    cells,
    frames,
    st.sampled_from(["RRT", "RRTConnect", "RRTstar"]),
    st.sampled_from(["uniform", "region", "frontier"]),
    st.sampled_from(["occupied", "free"]),
    st.sampled_from([0.0, 0.0, 0.7, 1.5]),
    st.booleans(),
    st.integers(0, 2**63),
)
def test_answers_are_true(cells, frame, planner, strategy, unknown, radius, simplify, seed):
    m = make_map(cells, frame)
    rng = np.random.default_rng(seed)
    free = inflate((m.cells == 0) | ((m.cells == 2) & (unknown == "free")), radius)
    pixels = rng.uniform((0, 0), (m.width, m.height), (2, 2))
    if free.any():
        pixels = rng.choice(np.argwhere(free), 2)[:, ::-1] + rng.uniform(0.01, 0.99, (2, 2))
    start, goal = (m.to_world(p) for p in pixels)
    options = {
        "planner": planner,
        "strategy": strategy,
        "predictor": lrrt.GivenRegion(rng.random(m.cells.shape).astype(np.float32)),
        "unknown": unknown,
        "radius": radius * (frame[0] if frame else 1.0),
        "simplify": simplify,
        "iteration_limit": 500,
        "time_limit": 30.0,
        "seed": seed,
    }
    result = lrrt.plan(m, start, goal, **options)
    a, b = (tuple(int(x) for x in np.floor(p)) for p in pixels)
    if not free[a[1], a[0]]:
        assert result.status == "start_occupied"
    elif not free[b[1], b[0]]:
        assert result.status == "goal_occupied"
    elif not oracle.reachable(free, a)[b[1], b[0]]:
        assert result.status == "not_connected"
    else:
        assert result.status in ("solved", "iteration_limit")
    if result.solved:
        path = np.array([m.to_pixel(p) for p in result.path])
        assert oracle.first_collision(free, path) is None
        assert (result.path[0] == start).all() and (result.path[-1] == goal).all()
        assert math.isclose(result.cost, oracle.length(result.path), rel_tol=1e-9, abs_tol=1e-12)
        costs = result.cost_history[:, 2]
        assert (np.diff(costs) < 0).all() and math.isclose(costs[-1], result.cost, rel_tol=1e-9)
    again = lrrt.plan(m, start, goal, **options)
    assert again.status == result.status and np.array_equal(again.path, result.path)


@many
@given(cells, st.tuples(st.floats(1e-6, 1e6), st.floats(-1e9, 1e9), st.floats(-1e9, 1e9), st.floats(-10, 10)))
def test_conversions_round_trip(cells, frame):
    m = make_map(cells, frame)
    resolution, x, y, yaw = frame
    slack = 1e-14 * (max(abs(x), abs(y)) / resolution + m.width + m.height)
    for pixel in np.random.default_rng(cells[3]).uniform((-5, -5), (m.width + 5, m.height + 5), (10, 2)):
        world = np.array(m.to_world(pixel))
        turned = complex(*(world - (x, y))) * np.exp(-1j * yaw) / resolution
        np.testing.assert_allclose(m.to_pixel(world), pixel, atol=slack, rtol=0)
        np.testing.assert_allclose((turned.real, m.height - turned.imag), pixel, atol=slack, rtol=0)
