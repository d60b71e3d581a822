# SPDX-License-Identifier: BSD-3-Clause
"""Plan on a picture: dark pixels are obstacles, coordinates are pixels (x right, y down).

python examples/01_plan_on_a_picture.py [output.png]
"""

import sys
from pathlib import Path

import lrrt

picture = Path(__file__).parents[1] / "python" / "lrrt" / "data" / "maze35.png"
output = sys.argv[1] if len(sys.argv) > 1 else "01_plan_on_a_picture.png"

m = lrrt.read_map(picture)
result = lrrt.plan(m, start=(10.5, 10.5), goal=(234.5, 234.5), time_limit=60.0, keep_tree=True)
print(f"{result.status}: {result.cost:.1f} pixels, {result.iterations} iterations, {result.timings['total']:.0f} ms")
lrrt.draw(m, result=result).figure.savefig(output)
sys.exit(0 if result.solved else 1)
