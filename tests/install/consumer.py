# SPDX-License-Identifier: BSD-3-Clause
"""consumer.py: the installed Python package as a user's program meets it. Checked by mypy --strict, then run."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import numpy.typing as npt

import lrrt


def two_rooms() -> lrrt.OccupancyMap:
    occupied: npt.NDArray[np.bool_] = np.zeros((60, 80), dtype=bool)
    occupied[:45, 40:43] = True
    return lrrt.OccupancyMap.from_array(occupied)


def planned(map_: lrrt.OccupancyMap, start: tuple[float, float], goal: tuple[float, float]) -> lrrt.PlanResult:
    result = lrrt.plan(map_, start, goal, planner="RRTstar", strategy="frontier", alpha=0.8, seed=3)
    assert result.solved and result.status == "solved", result.status
    return result


def main() -> None:
    map_ = two_rooms()
    start, goal = (5.5, 5.5), (74.5, 5.5)
    result = planned(map_, start, goal)
    path: npt.NDArray[np.float64] = result.path
    cost: float = result.cost
    steps: int = result.iterations
    assert path.shape[1] == 2 and tuple(path[0]) == start and tuple(path[-1]) == goal

    predictor = lrrt.OnnxPredictor()
    model: Path = Path(predictor.info.path)
    package = Path(lrrt.__file__).parent
    assert model.is_relative_to(package), f"the model is {model}, not the package's own"
    region, timings = predictor.predict_timed(map_, start, goal)
    assert region.area > 0 and sum(timings.values()) > 0.0

    try:
        lrrt.read_map("missing.png")
    except lrrt.MapError as error:
        assert "missing.png" in str(error)
    else:
        raise AssertionError("a missing map was read")
    print(f"lrrt {lrrt.__version__}: a path of length {cost:.1f} after {steps} iterations; {model.name} of the package")


if __name__ == "__main__":
    main()
