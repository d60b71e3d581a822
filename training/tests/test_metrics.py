# SPDX-License-Identifier: BSD-3-Clause
"""Metrics on 5×5 maps small enough to count by hand."""

from __future__ import annotations

import numpy as np
import pytest
import torch

from lrrt_training.metrics import RegionMetrics, accuracy, redundancy

# # obstacle, . free, * path, S and G path at the start and the goal
MAP = """
#####
#S..#
#*#.#
#*G.#
#####
"""


def read(text: str) -> torch.Tensor:
    """Label of a drawn map."""
    return torch.tensor([[".#*".index(c) if c in ".#*" else 2 for c in row] for row in text.split()])


def region(text: str) -> torch.Tensor:
    """A drawn region: x inside."""
    return torch.tensor([[c == "x" for c in row] for row in text.split()])


LABEL = read(MAP)
EXACT = region("..... .x... .x... .xx.. .....")
GAP = region("..... .x... ..... .xx.. .....")
WIDE = region("..... .xxx. .x.x. .xxx. .....")
WALLS = region("xxxxx xx..x xxx.x xxx.x xxxxx")
NOTHING = torch.zeros(5, 5, dtype=torch.bool)

CASES = {  # region: accuracy, redundancy, connected
    "exact": (EXACT, 1.0, 0.0, True),
    "gap": (GAP, 0.75, 0.0, False),
    "wide": (WIDE, 1.0, 1.0, True),
    "walls do not count": (WALLS, 1.0, 0.0, True),
    "nothing": (NOTHING, 0.0, 0.0, False),
}


def test_the_drawing_is_read_as_meant():
    assert LABEL.tolist()[1] == [1, 2, 0, 0, 1]
    assert (LABEL == 2).sum() == 4
    assert (LABEL == 1).sum() == 17


@pytest.mark.parametrize("name", CASES)
def test_by_hand(name):
    predicted, right, excess, _ = CASES[name]
    assert accuracy(predicted[None], LABEL[None]).tolist() == [right]
    assert redundancy(predicted[None], LABEL[None]).tolist() == [excess]


def test_a_map_without_path_is_no_division_by_zero():
    label = torch.zeros(1, 2, 2, dtype=torch.long)
    assert accuracy(torch.ones(1, 2, 2, dtype=torch.bool), label).tolist() == [0.0]
    assert redundancy(torch.ones(1, 2, 2, dtype=torch.bool), label).tolist() == [4.0]


def update(metrics: RegionMetrics, *cases: tuple[str, str]) -> RegionMetrics:
    """Adds cases, each a group and the name of a region."""
    groups, regions = zip(*((group, CASES[name]) for group, name in cases))
    labels = LABEL.expand(len(cases), 5, 5)
    metrics.update(torch.stack([r[0] for r in regions]), labels, list(groups), [r[3] for r in regions])
    return metrics


def test_means_of_every_group_and_of_all():
    scores = update(RegionMetrics(["9", "5", "rooms"]), ("5", "exact"), ("5", "gap"), ("9", "wide")).compute()
    assert list(scores) == ["9", "5", "all"], "in the order of the groups; one without maps is left out"
    assert scores["5"] == {
        "accuracy": 0.875,
        "redundancy": 0.0,
        "metric": 0.125,
        "connectivity": 0.5,
        "linked": 0.0,
        "count": 2,
    }
    assert scores["9"] == {
        "accuracy": 1.0,
        "redundancy": 1.0,
        "metric": 1.0,
        "connectivity": 1.0,
        "linked": 0.0,
        "count": 1,
    }
    assert scores["all"]["accuracy"] == pytest.approx(2.75 / 3)
    assert scores["all"]["redundancy"] == pytest.approx(1 / 3)
    assert scores["all"]["metric"] == pytest.approx(0.25 / 3 + 1 / 3)
    assert scores["all"]["connectivity"] == pytest.approx(2 / 3)
    assert scores["all"]["count"] == 3


@pytest.mark.filterwarnings("ignore:The ``compute`` method")
def test_no_map_at_all():
    assert RegionMetrics(["5"]).compute() == {
        "all": {"accuracy": 0.0, "redundancy": 0.0, "metric": 1.0, "connectivity": 0.0, "linked": 0.0, "count": 0}
    }


def test_a_group_without_name_is_an_error():
    with pytest.raises(ValueError, match="'7' is not in list"):
        update(RegionMetrics(["5"]), ("7", "exact"))


def test_two_processes_together_count_as_one():
    cases = [("5", "exact"), ("5", "gap"), ("9", "wide"), ("9", "nothing"), ("5", "walls do not count")]
    whole = update(RegionMetrics(["5", "9"]), *cases).compute()
    one, two = update(RegionMetrics(["5", "9"]), *cases[:2]), update(RegionMetrics(["5", "9"]), *cases[2:])
    other = two.sums.clone()
    one.distributed_available_fn = lambda: True
    one.dist_sync_fn = lambda mine, group: [mine, other]
    assert one.compute() == whole


def test_reset_forgets():
    metrics = update(RegionMetrics(["5"]), ("5", "gap"))
    metrics.reset()
    assert update(metrics, ("5", "exact")).compute()["5"]["accuracy"] == 1.0


def slow_scores(region: np.ndarray, label: np.ndarray) -> tuple[float, float]:
    """Accuracy and redundancy, pixel by pixel."""
    path = hit = excess = 0
    for row, column in np.ndindex(label.shape):
        inside = bool(region[row, column])
        if label[row, column] == 2:
            path, hit = path + 1, hit + inside
        elif label[row, column] == 0:
            excess += inside
    return hit / path, excess / path


@pytest.mark.parametrize("seed", range(5))
def test_against_a_slow_reference(seed):
    rng = np.random.default_rng(seed)
    label, region = rng.integers(0, 3, (6, 9, 11)), rng.random((6, 9, 11)) < rng.random()
    expected = [slow_scores(*pair) for pair in zip(region, label)]
    one, other = torch.from_numpy(region), torch.from_numpy(label)
    assert accuracy(one, other).tolist() == pytest.approx([e[0] for e in expected])
    assert redundancy(one, other).tolist() == pytest.approx([e[1] for e in expected])
    metrics = RegionMetrics(["rooms", "21"])
    metrics.update(one, other, ["rooms"] * 4 + ["21"] * 2, [True] * 3 + [False] * 3)
    scores = metrics.compute()
    assert scores["21"]["metric"] == pytest.approx(np.mean([1 - a + r for a, r in expected[4:]]))
    assert scores["all"]["metric"] == pytest.approx(np.mean([1 - a + r for a, r in expected]))
    assert [scores[g]["connectivity"] for g in ("rooms", "21", "all")] == [0.75, 0.0, 0.5]
