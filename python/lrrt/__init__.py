# SPDX-License-Identifier: BSD-3-Clause
"""Sampling-based path planning guided by a learned promising region.

>>> import lrrt
>>> m = lrrt.read_map("office.yaml")  # a picture, a map_server YAML or a MovingAI map  # doctest: +SKIP
>>> result = lrrt.plan(m, start=(1.0, 2.0), goal=(14.5, 8.0))  # doctest: +SKIP
>>> lrrt.draw(m, result=result).figure.savefig("path.png")  # doctest: +SKIP
"""

from lrrt import _core
from lrrt._core import (
    AStarPredictor,
    CancelToken,
    Encoder,
    Encoding,
    Error,
    GivenRegion,
    MapError,
    ModelError,
    ModelInfo,
    OccupancyMap,
    OnnxPredictor,
    PlanResult,
    PotentialFieldPredictor,
    PromisingRegion,
    RefinedPredictor,
    RegionPredictor,
    RequestError,
    Scenario,
    __version__,
    control_planner_names,
    planner_names,
    read_scenarios,
    shortest_path,
    widened,
)
from lrrt.drawing import draw
from lrrt.maps import read_map
from lrrt.planning import default_predictor, plan
from lrrt.session import Session

__all__ = [
    "AStarPredictor",
    "CancelToken",
    "Encoder",
    "Encoding",
    "Error",
    "GivenRegion",
    "MapError",
    "ModelError",
    "ModelInfo",
    "OccupancyMap",
    "OnnxPredictor",
    "PlanResult",
    "PotentialFieldPredictor",
    "PromisingRegion",
    "RefinedPredictor",
    "RegionPredictor",
    "RequestError",
    "Scenario",
    "Session",
    "__version__",
    "control_planner_names",
    "default_predictor",
    "draw",
    "plan",
    "planner_names",
    "read_map",
    "read_scenarios",
    "shortest_path",
    "widened",
]

if hasattr(_core, "TorchScriptPredictor"):  # built with libtorch
    TorchScriptPredictor = _core.TorchScriptPredictor
    __all__ += ["TorchScriptPredictor"]
