# SPDX-License-Identifier: BSD-3-Clause
"""A robot on its way: it moves on, crates appear in front of it, and it plans again at every step.

python examples/07_replanning.py [output.png]
"""

import sys
from pathlib import Path

import numpy as np

import lrrt

output = sys.argv[1] if len(sys.argv) > 1 else "07_replanning.png"
m = lrrt.read_map(Path(__file__).parent / "office.yaml")
start, goal, radius, step = (-5.7, 12.2), (14.1, 4.4), 0.2, 1.0  # metres

session = lrrt.Session(m, planner="RRTConnect", radius=radius, simplify=True)
result = session.plan(start, goal)
print(f"planned: {result.cost:.1f} m, {result.timings['total']:.1f} ms")


def along(path: np.ndarray, distance: float) -> np.ndarray:
    """The point of a path after so many metres."""
    for a, b in zip(path, path[1:]):
        length = np.linalg.norm(b - a)
        if distance <= length:
            return a + (b - a) * (distance / length if length else 0.0)
        distance -= length
    return path[-1]


cells = before = m.cells.copy()
driven, slowest = [np.array(start)], 0.0
while result.solved and np.linalg.norm(driven[-1] - goal) > 1e-6:
    driven.append(along(result.path, step))
    if len(driven) % 4 == 0 and result.cost > 4 * step:  # a crate of 0.3 m, three metres ahead
        column, row = (int(v) for v in m.to_pixel(along(result.path, 3 * step)))
        before = cells.copy()
        cells[row - 1 : row + 2, column - 1 : column + 2] = 1
        session.update(lrrt.OccupancyMap.from_array(cells, m.resolution, m.origin))
    result = session.replan(driven[-1])
    if not result.solved:  # it stands in a door, and there is no other: somebody takes it away
        print(f"{len(driven) - 1:3d} m: {result.status}")
        cells = before
        session.update(lrrt.OccupancyMap.from_array(cells, m.resolution, m.origin))
        result = session.replan(driven[-1])
    slowest = max(slowest, result.timings["total"])
    print(f"{len(driven) - 1:3d} m: {result.status}, {result.cost:5.1f} m to go, {result.timings['total']:6.2f} ms")

print(f"arrived: {result.solved}, slowest step {slowest:.1f} ms")
axes = lrrt.draw(session.map, start=start, goal=goal)
axes.plot(*np.array(driven).T, color="#f2660a", marker=".", linewidth=1.5)
axes.figure.savefig(output)
sys.exit(0 if result.solved else 1)
