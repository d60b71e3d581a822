# SPDX-License-Identifier: BSD-3-Clause
"""Predict only: where would a path probably lie? For those who bring their own planner.

python examples/02_predict_only.py [output.png]
"""

import sys
from pathlib import Path

import lrrt

picture = Path(__file__).parents[1] / "python" / "lrrt" / "data" / "maze35.png"
output = sys.argv[1] if len(sys.argv) > 1 else "02_predict_only.png"

m = lrrt.read_map(picture)
predictor = lrrt.OnnxPredictor()  # load once, use for every query and from every thread
start, goal = (10.5, 10.5), (234.5, 234.5)
region, timings = predictor.predict_timed(m, start, goal)

print(f"{region.area} promising pixels, connected: {region.connected}, {sum(timings.values()):.0f} ms")
print(f"most probable pixel: {region.probability.max():.3f}")
lrrt.draw(m, region=region, start=start, goal=goal).figure.savefig(output)
