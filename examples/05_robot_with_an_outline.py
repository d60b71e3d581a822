# SPDX-License-Identifier: BSD-3-Clause
"""A map_server map in metres, and a robot with an outline that turns on the spot.

python examples/05_robot_with_an_outline.py [output.png] [map.yaml]
"""

import sys
from pathlib import Path

import numpy as np

import lrrt

output = sys.argv[1] if len(sys.argv) > 1 else "05_robot_with_an_outline.png"
m = lrrt.read_map(sys.argv[2] if len(sys.argv) > 2 else Path(__file__).parent / "office.yaml")

# An L: a base of 0.7 m × 0.5 m with an arm to the front. It drives along +x; the origin is what start and goal mean.
outline = [(-0.3, -0.25), (0.4, -0.25), (0.4, 0.05), (0.7, 0.05), (0.7, 0.25), (-0.3, 0.25)]
start, goal = (-5.7, 12.2), (14.1, 4.4)
result = lrrt.plan(m, start, goal, outline=outline, motion="turning", planner="RRTConnect", simplify=True)
print(f"{result.status}: {len(result.path)} poses, {result.timings['total']:.0f} ms")

axes = lrrt.draw(m, result=result, start=start, goal=goal)
corners = np.array([*outline, outline[0]])
for (x, y), heading in list(zip(result.path, result.headings))[::25]:
    turn = np.array([[np.cos(heading), np.sin(heading)], [-np.sin(heading), np.cos(heading)]])
    axes.plot(*(corners @ turn + (x, y)).T, color="#1b4f9c", linewidth=0.6)
axes.figure.savefig(output)
sys.exit(0 if result.solved else 1)
