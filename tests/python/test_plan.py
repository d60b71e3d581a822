# SPDX-License-Identifier: BSD-3-Clause
from __future__ import annotations

import math
import os
import signal
import threading
import time
from pathlib import Path

import numpy as np
import oracle
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import lrrt
from lrrt import planning

OPEN = lrrt.OccupancyMap.from_array(np.zeros((60, 60), bool))


def random_map(rng: np.random.Generator, side: int) -> np.ndarray:
    """(H, W) bool, True = occupied: boxes on a free ground."""
    height, width = rng.integers(8, side, 2)
    occupied = np.zeros((height, width), bool)
    for _ in range(rng.integers(0, 14)):
        r, c = rng.integers(height), rng.integers(width)
        occupied[r : r + rng.integers(1, height // 2), c : c + rng.integers(1, width // 2)] = True
    occupied[0, 0] = False
    return occupied


def random_point(rng: np.random.Generator, free: np.ndarray) -> tuple[float, float]:
    row, column = rng.choice(np.argwhere(free))
    return column + rng.random(), row + rng.random()


def check(result: lrrt.PlanResult, m: lrrt.OccupancyMap, free: np.ndarray, start, goal) -> None:
    """What must hold of any result."""
    if result.status == "not_connected":
        a, b = (np.floor(m.to_pixel(p)).astype(int) for p in (start, goal))
        assert not oracle.reachable(free, tuple(a))[b[1], b[0]]
    if not result.solved:
        assert result.path.shape == (0, 2) and math.isinf(result.cost)
        return
    assert result.path.dtype == np.float64 and result.path.shape[1] == 2
    np.testing.assert_allclose(result.path[[0, -1]], (start, goal), atol=1e-9)
    assert oracle.first_collision(free, np.array([m.to_pixel(p) for p in result.path])) is None
    assert result.cost == pytest.approx(oracle.length(result.path), abs=1e-9)
    costs = result.cost_history[:, 2]
    assert (np.diff(costs) < 0).all() and costs[-1] == pytest.approx(result.cost, abs=1e-6)


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.integers(0, 2**32), st.sampled_from(lrrt.planner_names()), st.sampled_from(["uniform", "region", "frontier"]))
def test_results_are_honest(predictor, seed, planner, strategy):
    rng = np.random.default_rng(seed)
    free = ~random_map(rng, 60)
    metric = {"resolution": 0.05, "origin": (-3.0, 4.0, float(rng.uniform(-3, 3)))} if rng.random() < 0.5 else {}
    m = lrrt.OccupancyMap.from_array(~free, **metric)
    start, goal = (m.to_world(random_point(rng, free)) for _ in range(2))
    vouched_for = planner in ("RRT", "RRTConnect", "RRTstar")  # of OMPL's others some give up on small maps
    time_limit = 5.0 if vouched_for else 0.2
    result = lrrt.plan(
        m, start, goal, planner=planner, strategy=strategy, predictor=predictor, seed=seed + 1, time_limit=time_limit
    )
    assert result.status in ("solved", "not_connected") or not vouched_for
    check(result, m, free, start, goal)


def test_the_contract_of_the_readme(hall, predictor):
    result = lrrt.plan(
        hall,
        (10.5, 35.5),
        (55.5, 5.5),
        planner="RRTstar",
        strategy="region",
        alpha=0.8,
        predictor=predictor,
        stop="first",
        time_limit=5.0,
        range=6.0,
        seed=1,
    )
    assert result.status == "solved" and result.solved
    assert result.iterations > 0 and result.nodes > 0
    assert set(result.timings) == {"prepare", "encode", "infer", "region", "plan", "total"}
    stages = sum(v for k, v in result.timings.items() if k != "total")
    assert stages <= result.timings["total"] + 1e-6
    assert result.draws["guided"] > 0
    assert result.region is result.region or result.region.connected
    assert result.tree.shape == (0, 4)
    check(result, hall, hall.cells == 0, (10.5, 35.5), (55.5, 5.5))


def test_the_same_seed_gives_the_same_result(hall, predictor):
    options = {"predictor": predictor, "stop": "limit", "iteration_limit": 800, "time_limit": 60.0, "keep_tree": True}
    first, second = (lrrt.plan(hall, (10.5, 35.5), (55.5, 5.5), seed=7, **options) for _ in range(2))
    np.testing.assert_array_equal(first.path, second.path)
    np.testing.assert_array_equal(first.tree, second.tree)
    assert first.iterations == second.iterations == 800
    other = lrrt.plan(hall, (10.5, 35.5), (55.5, 5.5), seed=8, **options)
    assert not np.array_equal(first.tree, other.tree)


@pytest.mark.parametrize(
    ("start", "goal", "status"),
    [
        ((-1, 5), (55, 5), "start_outside"),
        ((10, 35), (60, 5), "goal_outside"),
        ((30.5, 5), (55, 5), "start_occupied"),
        ((10, 35), (2, 2), "goal_occupied"),
        ((10, 35), (50, 15), "not_connected"),
    ],
)
def test_hopeless_queries_have_their_own_status(hall, start, goal, status):
    result = lrrt.plan(hall, start, goal)
    assert result.status == status and not result.solved and result.iterations == 0
    assert result.timings["infer"] == 0


def test_unknown_is_what_the_caller_says(hall):
    assert lrrt.plan(hall, (10, 35), (2, 2), unknown="free").solved


def test_a_robot_needs_room(hall):
    free = lrrt.plan(hall, (10.5, 35.5), (55.5, 35.5), radius=4.0, strategy="uniform")
    assert free.solved and free.path[:, 1].max() <= 36.0
    assert lrrt.plan(hall, (10.5, 35.5), (55.5, 35.5), radius=5.5, strategy="uniform").status != "solved"


@pytest.mark.parametrize(
    ("options", "word"),
    [
        ({"alpha": 1.5}, "alpha"),
        ({"alpha": math.nan}, "alpha"),
        ({"planner": "A*"}, "RRTstar"),
        ({"strategy": "frontal"}, "uniform"),
        ({"stop": "soon"}, "first"),
        ({"range": -1.0}, "range"),
        ({"range": 1e-9}, "range"),
        ({"time_limit": 0.0}, "time_limit"),
        ({"radius": -1.0}, "radius"),
        ({"unknown": "maybe"}, "occupied"),
        ({"neighbors": "kd"}, "grid"),
        ({"on_predict_error": "ignore"}, "unguided"),
        ({"goal_bias": 0.0}, "goal_tolerance"),
        ({"planner": "RRT", "stop": "limit"}, "RRTstar"),
    ],
)
def test_options_out_of_range_are_refused(options, word):
    with pytest.raises(lrrt.RequestError, match=word):
        lrrt.plan(OPEN, (1, 1), (50, 50), **options)


MODELS = Path(__file__).parents[1] / "data/models"


def test_a_model_may_be_named():
    assert lrrt.plan(OPEN, (1, 1), (50, 50), model=MODELS / "green.onnx").region is not None
    with pytest.raises(lrrt.RequestError, match="both"):
        lrrt.plan(OPEN, (1, 1), (50, 50), model="a.onnx", predictor=lrrt.AStarPredictor())


@pytest.mark.parametrize("name", ["missing", "no_size", "nan"])  # no file, cannot be loaded, cannot predict
def test_a_model_that_fails_is_raised_or_done_without(name):
    query = (OPEN, (1, 1), (50, 50))
    model = MODELS / f"{name}.onnx"
    with pytest.raises(lrrt.ModelError, match=model.name):
        lrrt.plan(*query, model=model)
    result = lrrt.plan(*query, model=model, on_predict_error="unguided")
    assert result.solved and result.region is None and model.name in result.predict_error
    plain = lrrt.plan(*query, strategy="uniform")
    assert plain.predict_error == "" and np.array_equal(result.path, plain.path)


def test_a_default_model_that_fails_is_done_without(monkeypatch, tmp_path):
    monkeypatch.setattr(planning, "_default", None)
    monkeypatch.setenv("LRRT_MODEL", str(tmp_path / "gone.onnx"))
    with pytest.raises(lrrt.ModelError, match="gone"):
        lrrt.plan(OPEN, (1, 1), (50, 50))
    assert "gone" in lrrt.plan(OPEN, (1, 1), (50, 50), on_predict_error="unguided").predict_error


def test_a_region_of_another_size_is_the_callers_mistake():
    region = lrrt.GivenRegion(np.ones((3, 3), np.float32))
    for word in ("raise", "unguided"):
        with pytest.raises(lrrt.RequestError):
            lrrt.plan(OPEN, (1, 1), (50, 50), predictor=region, on_predict_error=word)
    turned = lrrt.GivenRegion(np.ones((30, 120), np.float32))  # as many pixels as the map
    with pytest.raises(lrrt.RequestError, match="120×30 pixels, the map 60×60"):
        lrrt.plan(OPEN, (1, 1), (50, 50), predictor=turned)


@pytest.mark.parametrize("value", [math.nan, -0.1, 7.0])
def test_a_region_of_no_probabilities_is_refused(value):
    region = np.ones((60, 60), np.float32)
    region[3, 5] = value
    with pytest.raises(lrrt.RequestError, match=r"pixel \(5, 3\)"):
        lrrt.GivenRegion(region)


@pytest.mark.parametrize("point", [(math.nan, 1), (1, math.inf)])
def test_points_that_are_no_numbers_are_refused(point):
    with pytest.raises(lrrt.RequestError, match="start"):
        lrrt.plan(OPEN, point, (50, 50))


@pytest.mark.parametrize("point", ["abc", None, (1,), (1, 2, 3), (1j, 2), [None, 1], (10**400, 1), ((1, 2), (3, 4))])
def test_what_is_no_point_is_refused_by_name(point):
    for name, ends in (("start", (point, (50, 50))), ("goal", ((1, 1), point))):
        with pytest.raises(lrrt.RequestError, match=rf"^{name} is .*expected \(x, y\)"):
            lrrt.plan(OPEN, *ends, strategy="uniform")
    with pytest.raises(lrrt.RequestError, match=r"^outline\[1\] is "):
        lrrt.plan(OPEN, (1, 1), (50, 50), strategy="uniform", motion="turning", outline=[(1, 1), point, (0, 1)])


@pytest.mark.parametrize("name", ["seed", "iteration_limit"])
@pytest.mark.parametrize("value", [-1, 1 << 64, 1.5, "3"])
def test_counts_out_of_range_are_refused_by_name(name, value):
    with pytest.raises(lrrt.RequestError, match=f"^{name} is "):
        lrrt.plan(OPEN, (1, 1), (50, 50), strategy="uniform", **{name: value})
    with pytest.raises(lrrt.RequestError, match=f"^{name} is "):
        lrrt.Session(OPEN, strategy="uniform", **{name: value})


def test_an_outline_of_too_many_corners_is_refused_at_once():
    angles = np.linspace(0.0, 2.0 * math.pi, 60_000, endpoint=False)
    circle = np.column_stack((np.cos(angles), np.sin(angles)))
    with pytest.raises(lrrt.RequestError, match="60000 vertices, at most 4096"):
        lrrt.plan(OPEN, (1, 1), (50, 50), strategy="uniform", motion="turning", outline=circle)


def test_neighbours_change_nothing_but_the_time():
    rng = np.random.default_rng(3)
    m = lrrt.OccupancyMap.from_array(random_map(rng, 60))
    ours, theirs = (
        lrrt.plan(m, (0.5, 0.5), (0.5, 5.5), strategy="uniform", stop="limit", iteration_limit=2000, neighbors=word)
        for word in ("grid", "ompl")
    )
    assert ours.nodes == theirs.nodes and ours.motion_checks == theirs.motion_checks > 0
    assert np.array_equal(ours.path, theirs.path)


def test_limits_end_a_search():
    assert lrrt.plan(OPEN, (1, 1), (50, 50), strategy="uniform", stop="limit", iteration_limit=50).iterations == 50
    began = time.perf_counter()
    lrrt.plan(OPEN, (1, 1), (50, 50), strategy="uniform", stop="limit", time_limit=0.2)
    assert 0.2 <= time.perf_counter() - began < 2.0


def test_the_gil_is_free_while_planning():
    counted = 0
    done = threading.Event()

    def count() -> None:
        nonlocal counted
        while not done.is_set():
            counted += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    lrrt.plan(OPEN, (1, 1), (50, 50), strategy="uniform", stop="limit", time_limit=0.5)
    done.set()
    thread.join()
    assert counted > 20


def test_another_thread_can_cancel():
    token = lrrt.CancelToken()
    threading.Timer(0.2, token.cancel).start()
    began = time.perf_counter()
    lrrt.plan(OPEN, (1, 1), (50, 50), strategy="uniform", stop="limit", time_limit=60.0, cancel=token)
    assert token.cancelled and time.perf_counter() - began < 5.0


@pytest.fixture
def interruptible():
    """Python's own handler of Ctrl-C: a parent that runs in the background may have handed down that it is ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("interruptible")
def test_ctrl_c_ends_a_search():
    threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    began = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        lrrt.plan(OPEN, (1, 1), (50, 50), strategy="uniform", stop="limit", time_limit=60.0)
    assert time.perf_counter() - began < 5.0
    assert lrrt.plan(OPEN, (1, 1), (50, 50), strategy="uniform").solved


def test_more_time_shortens_the_path():
    first = lrrt.plan(OPEN, (1, 1), (50, 50), strategy="uniform")
    longer = lrrt.plan(OPEN, (1, 1), (50, 50), strategy="uniform", stop="limit", iteration_limit=4000)
    assert math.hypot(49, 49) <= longer.cost < first.cost
    near = lrrt.plan(OPEN, (1, 1), (50, 50), strategy="uniform", stop="factor", cost_factor=1.1)
    assert near.cost <= 1.1 * math.hypot(49, 49) + 1e-6


@pytest.mark.parametrize("motion", ["turning", "dubins", "reeds_shepp"])
def test_a_robot_with_an_outline_gets_headings(motion: str) -> None:
    outline = [(-1.0, -1.0), (3.0, -1.0), (3.0, 1.0), (-1.0, 1.0)]
    result = lrrt.plan(
        OPEN,
        (10, 10),
        (50, 40),
        strategy="uniform",
        planner="RRTConnect",
        outline=outline,
        motion=motion,
        turning_radius=4.0,
        start_heading=0.5,
        goal_heading=-2.0,
        simplify=True,
    )
    assert result.solved
    assert result.headings.shape == (len(result.path),)
    assert result.path[0].tolist() == [10, 10] and result.path[-1].tolist() == [50, 40]
    assert result.headings[0] == 0.5 and result.headings[-1] == -2.0
    steps = np.linalg.norm(np.diff(result.path, axis=0), axis=1)
    assert steps.max() <= 1 + 1e-6
    assert result.cost >= steps.sum() - 1e-6


def test_an_outline_needs_headings() -> None:
    square = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    with pytest.raises(lrrt.RequestError, match="turning"):
        lrrt.plan(OPEN, (10, 10), (50, 40), strategy="uniform", outline=square)
    with pytest.raises(lrrt.RequestError, match="motion"):
        lrrt.plan(OPEN, (10, 10), (50, 40), strategy="uniform", motion="flying")
    assert lrrt.plan(OPEN, (10, 10), (50, 40), strategy="uniform").headings.shape == (0,)


def test_a_large_map_is_guided_in_larger_pixels_and_drawn_where_it_lies() -> None:
    occupied = np.zeros((1500, 1290), dtype=bool)
    occupied[700:720, :1200] = True
    map_ = lrrt.OccupancyMap.from_array(occupied)
    result = lrrt.plan(map_, (100, 100), (100, 1400))
    assert result.solved and result.region is not None
    assert result.region.coarseness == 2
    assert result.region.mask.shape == (750, 645)
    images = [image for image in lrrt.draw(map_, result=result).get_images() if image.get_label() == "region"]
    assert images[0].get_extent() == [0, 1290, 1500, 0]


def test_parts_and_larger_pixels_of_a_map_keep_its_units() -> None:
    map_ = lrrt.OccupancyMap.from_array(np.eye(8, dtype=bool), resolution=0.5, origin=(1.0, 2.0, 0.3))
    coarse, part = map_.coarsened(2), map_.cropped(1, 2, 4, 5)
    assert (coarse.width, coarse.coarseness, coarse.resolution) == (4, 2, 1.0)
    assert np.allclose(coarse.to_world((1.5, 2.5)), map_.to_world((3.0, 5.0)))
    assert np.allclose(part.to_world((0.0, 0.0)), map_.to_world((1.0, 2.0)))
    assert np.array_equal(part.cells, map_.cells[2:7, 1:5])
    with pytest.raises(lrrt.MapError, match="power of two"):
        map_.coarsened(3)
    with pytest.raises(lrrt.MapError, match="inside the map"):
        map_.cropped(5, 5, 4, 4)


def driven(pose: np.ndarray, controls: np.ndarray) -> np.ndarray:
    """Where controls lead, by small steps."""
    x, y, yaw = pose
    for speed, turn_rate, duration in controls:
        steps = 2000
        angles = yaw + turn_rate * duration * (np.arange(steps) + 0.5) / steps
        x += speed * duration * np.cos(angles).mean()
        y += speed * duration * np.sin(angles).mean()
        yaw += turn_rate * duration
    return np.array([x, y, yaw])


@pytest.mark.parametrize("planner", lrrt.control_planner_names())
@pytest.mark.parametrize("motion", ["unicycle", "car"])
def test_a_driven_robot_gets_controls(motion: str, planner: str) -> None:
    limits = {"speed": 2.0, "reverse_speed": 1.0, "turn_rate": 0.6, "turning_radius": 3.0}
    result = lrrt.plan(
        OPEN,
        (10, 10),
        (50, 40),
        strategy="uniform",
        planner=planner,
        outline=[(-1.0, -1.0), (3.0, -1.0), (3.0, 1.0), (-1.0, 1.0)],
        motion=motion,
        start_heading=0.5,
        goal_heading=-2.0,
        goal_tolerance=4.0,
        heading_tolerance=0.8,
        time_limit=20.0,
        **limits,
    )
    assert result.solved
    speeds, turn_rates, durations = result.controls.T
    assert speeds.max() <= 2.0 + 1e-9 and speeds.min() >= -1.0 - 1e-9
    if motion == "car":
        assert (np.abs(turn_rates) * 3.0 <= np.abs(speeds) + 1e-9).all()
    else:
        assert np.abs(turn_rates).max() <= 0.6 + 1e-9
    assert result.cost == pytest.approx(durations.sum())
    end = driven(np.array([10, 10, 0.5]), result.controls)
    np.testing.assert_allclose(end[:2], result.path[-1], atol=1e-5)
    assert math.cos(end[2] - result.headings[-1]) == pytest.approx(1.0)
    assert result.goal_distance == pytest.approx(math.hypot(end[0] - 50, end[1] - 40), abs=1e-5) and (
        result.goal_distance <= 4.0
    )
    assert result.goal_turn <= 0.8


def test_other_motions_have_no_controls() -> None:
    result = lrrt.plan(OPEN, (10, 10), (50, 40), strategy="uniform")
    assert result.controls.shape == (0, 3)
    assert result.goal_distance == 0.0 and result.goal_turn == 0.0
    with pytest.raises(lrrt.RequestError, match="SST"):
        lrrt.plan(OPEN, (10, 10), (50, 40), strategy="uniform", motion="car", speed=1, turning_radius=3)


def test_clearance_costs_and_keeps_away() -> None:
    cells = np.zeros((40, 60), dtype=bool)
    cells[18:22, 20:40] = True
    m = lrrt.OccupancyMap.from_array(cells)
    options = {"strategy": "uniform", "stop": "limit", "iteration_limit": 3000, "time_limit": 60.0}
    near, far = (lrrt.plan(m, (5, 20), (55, 20), clearance=c, **options) for c in (0.0, 6.0))
    assert oracle.length(far.path) > oracle.length(near.path)
    assert far.cost > oracle.length(far.path) - 1e-9 and near.cost == pytest.approx(oracle.length(near.path))
    with pytest.raises(lrrt.RequestError, match="clearance"):
        lrrt.plan(m, (5, 20), (55, 20), clearance=-1.0)
