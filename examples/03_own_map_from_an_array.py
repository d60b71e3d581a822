# SPDX-License-Identifier: BSD-3-Clause
"""Your own map from an array, in metres, for a robot with a radius.

python examples/03_own_map_from_an_array.py [output.png]
"""

import sys

import numpy as np

import lrrt

output = sys.argv[1] if len(sys.argv) > 1 else "03_own_map_from_an_array.png"

# 12 m × 8 m at 5 cm: two walls, each with a door of one metre. Row 0 is the top of the picture, y = 8 m.
occupied = np.zeros((160, 240), dtype=bool)
occupied[:, 80:84] = True
occupied[:, 160:164] = True
occupied[20:40, 80:84] = False
occupied[120:140, 160:164] = False
m = lrrt.OccupancyMap.from_array(occupied, resolution=0.05, origin=(0.0, 0.0, 0.0))

start, goal = (1.0, 1.0), (11.0, 7.0)  # metres, y up
result = lrrt.plan(m, start, goal, radius=0.3, time_limit=10.0, keep_tree=True)
print(f"{result.status}: {result.cost:.2f} m, {len(result.path)} points, {result.timings['total']:.0f} ms")
lrrt.draw(m, result=result, start=start, goal=goal).figure.savefig(output)
sys.exit(0 if result.solved else 1)
