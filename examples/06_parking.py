# SPDX-License-Identifier: BSD-3-Clause
"""A car that parks backwards: arcs and straight lines, forwards and back (Reeds-Shepp).

python examples/06_parking.py [output.png]
"""

import math
import sys

import numpy as np

import lrrt

output = sys.argv[1] if len(sys.argv) > 1 else "06_parking.png"

# 20 m × 12 m at 10 cm: a lane, and under it a row of bays of 2.6 m with cars in all of them but one.
occupied = np.zeros((120, 200), dtype=bool)
occupied[:10] = True
for bay in range(7):
    left = 8 + 26 * bay
    occupied[64:, left : left + 2] = True
    if bay != 3:
        occupied[68:112, left + 6 : left + 23] = True
m = lrrt.OccupancyMap.from_array(occupied, resolution=0.1, origin=(0.0, 0.0, 0.0))

# 4.2 m × 1.7 m, the origin on the rear axle.
outline = [(-0.9, -0.85), (3.3, -0.85), (3.3, 0.85), (-0.9, 0.85)]
result = lrrt.plan(
    m,
    start=(2.0, 8.5),
    goal=(10.0, 1.8),
    start_heading=0.0,
    goal_heading=math.pi / 2,  # nose to the lane
    outline=outline,
    motion="reeds_shepp",
    turning_radius=4.0,
    planner="RRTConnect",
    simplify=True,
    time_limit=10.0,
)
print(f"{result.status}: {result.cost:.1f} m, {result.timings['total']:.0f} ms")

axes = lrrt.draw(m, result=result)
corners = np.array([*outline, outline[0]])
for (x, y), heading in list(zip(result.path, result.headings))[::15]:
    turn = np.array([[np.cos(heading), np.sin(heading)], [-np.sin(heading), np.cos(heading)]])
    axes.plot(*(corners @ turn + (x, y)).T, color="#1b4f9c", linewidth=0.6)
axes.figure.savefig(output)
sys.exit(0 if result.solved else 1)
