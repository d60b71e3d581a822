# SPDX-License-Identifier: BSD-3-Clause
from __future__ import annotations

import threading
from pathlib import Path

import numpy as np
import oracle
import pytest

import lrrt

TINY = Path(__file__).parents[1] / "data" / "models"
START, GOAL = (10.5, 35.5), (55.5, 5.5)


def test_the_default_model_tells_about_itself(predictor):
    info = predictor.info
    assert info.path.is_file() and info.name and info.training_data and info.commit
    assert "promising" in info.classes and 0 < info.threshold <= 1 and info.input_size >= 32
    assert predictor is lrrt.default_predictor()


def test_a_region_has_the_shape_of_the_map(hall, predictor):
    region = predictor.predict(hall, start=START, goal=GOAL)
    assert region.probability.shape == region.mask.shape == (40, 60)
    assert region.probability.dtype == np.float32 and region.mask.dtype == bool
    assert region.probability.min() >= 0 and region.probability.max() <= 1
    assert isinstance(region.connected, bool) and region.area == region.mask.sum()
    np.testing.assert_array_equal(region.mask, (hall.cells == 0) & (region.probability >= predictor.info.threshold))


def test_arrays_of_a_region_are_views_that_keep_it_alive(hall, predictor):
    mask = predictor.predict(hall, START, GOAL).mask
    assert not mask.flags.owndata and not mask.flags.writeable
    assert mask.sum() >= 0


def test_connected_is_what_a_flood_fill_says(hall):
    rng = np.random.default_rng(3)
    seen = set()
    for _ in range(60):
        probability = (rng.random((40, 60)) < rng.uniform(0.4, 1.0)).astype(np.float32)
        region = lrrt.PromisingRegion.from_array(hall, probability, START, GOAL)
        inside = (hall.cells == 0) & (probability >= 0.5)
        assert region.connected == oracle.reachable(inside, (10, 35))[5, 55]
        seen.add(region.connected)
    assert seen == {True, False}


def test_predictions_are_repeatable_and_timed(hall, predictor):
    first, timings = predictor.predict_timed(hall, START, GOAL)
    np.testing.assert_array_equal(first.probability, predictor.predict(hall, START, GOAL).probability)
    assert set(timings) == {"encode", "infer", "region"} and all(t >= 0 for t in timings.values())


def test_many_predictions_are_those_of_one_by_one(hall, predictor):
    free = np.argwhere(hall.cells == 0)[:, ::-1] + 0.5
    pairs = np.random.default_rng(5).choice(free, (19, 2))
    expected = [predictor.predict(hall, start, goal) for start, goal in pairs]
    for queries in (pairs, [(tuple(start), list(goal)) for start, goal in pairs]):
        regions = predictor.predict_many(hall, queries)
        assert len(regions) == 19
        for region, one in zip(regions, expected):
            assert region.probability.shape == (40, 60) and region.connected == one.connected
            np.testing.assert_allclose(region.probability, one.probability, atol=1e-5)


def test_no_queries_give_no_regions(hall, predictor):
    assert predictor.predict_many(hall, []) == [] == predictor.predict_many(hall, np.empty((0, 2, 2)))


def test_a_wrong_query_of_many_is_named(hall, predictor):
    queries = [(START, GOAL)] * 3
    with pytest.raises(lrrt.RequestError, match=r"^queries\[2\]: goal"):
        predictor.predict_many(hall, [*queries[:2], (START, (-1.0, 5.0))])
    for malformed in (START, (START, GOAL), [(START,)], [(START, GOAL, START)], np.zeros((2, 2)), np.zeros((1, 2, 3))):
        with pytest.raises(TypeError):
            predictor.predict_many(hall, malformed)


def test_many_predictions_let_other_threads_run(hall, predictor):
    started, done = threading.Event(), threading.Event()
    steps = 0

    def work() -> None:
        started.set()
        predictor.predict_many(hall, [(START, GOAL)] * 64)
        done.set()

    thread = threading.Thread(target=work)
    thread.start()
    started.wait()
    while not done.is_set():
        steps += 1
    thread.join()
    assert steps > 100


def test_the_picture_shows_map_and_region(hall, predictor):
    region = predictor.predict(hall, START, GOAL)
    picture = region.picture(hall)
    assert picture.shape == (40, 60, 3)
    assert (picture[region.mask] == (0, 255, 0)).all()
    assert (picture[hall.cells != 0] == 0).all()


def test_a_tiny_model_gives_what_it_must(hall):
    m = lrrt.OccupancyMap.from_array(np.zeros((16, 16), bool))
    region = lrrt.OnnxPredictor(TINY / "green.onnx").predict(m, (0.5, 0.5), (15.5, 15.5))
    expected = np.ones((16, 16))
    expected[0, 0] = expected[15, 15] = 0  # red and blue markers have no green
    np.testing.assert_allclose(region.probability, expected, atol=1e-6)


@pytest.mark.parametrize("start", [(2.5, 2.5), (-1.0, 5.0), (30.5, 5.5)])
def test_ends_that_are_not_free_are_refused(hall, predictor, start):
    with pytest.raises(lrrt.RequestError, match="start"):
        predictor.predict(hall, start, GOAL)


@pytest.mark.parametrize("name", ["no_size", "wrong_classes", "wrong_format"])
def test_models_that_do_not_fit_are_refused(name):
    with pytest.raises(lrrt.ModelError, match=f"{name}.onnx"):
        lrrt.OnnxPredictor(TINY / f"{name}.onnx")


@pytest.mark.parametrize("path", ["missing.onnx", "a" * 5000, "/"])
def test_missing_models_are_refused(path):
    with pytest.raises(lrrt.ModelError):
        lrrt.OnnxPredictor(path)


def test_every_error_is_an_lrrt_error_and_a_value_error():
    for kind in (lrrt.MapError, lrrt.ModelError, lrrt.RequestError):
        assert issubclass(kind, lrrt.Error) and issubclass(kind, ValueError)


def test_one_predictor_serves_many_threads(hall, predictor):
    expected = predictor.predict(hall, START, GOAL).probability
    equal = []

    def work() -> None:
        for _ in range(3):
            equal.append(np.array_equal(predictor.predict(hall, START, GOAL).probability, expected))

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert equal == [True] * 12


def test_the_encoder_paints_one_block_per_marker():
    blocks = np.ones((9, 9), bool)
    blocks[1:-1, 1:-1] = False
    encoding = lrrt.Encoder(size=64, marker_side=5).encode(lrrt.OccupancyMap.from_array(blocks), (1.5, 1.5), (7.5, 7.5))
    assert encoding.image.shape == (3, 64, 64) and encoding.scale == 7.0
    red, green, blue = encoding.image
    assert ((red == 255) & (green == 0)).sum() == 49 and ((blue == 255) & (green == 0)).sum() == 49
    free = encoding.to_input((~blocks).astype(np.uint8), fill=0)
    np.testing.assert_array_equal(free == 1, (red == 255) | (blue == 255))
    with pytest.raises(lrrt.RequestError):
        encoding.to_input(np.zeros((9, 9)), fill=0)
    with pytest.raises(lrrt.RequestError):
        encoding.to_input(np.zeros((3, 3), np.uint8), fill=0)
