# SPDX-License-Identifier: BSD-3-Clause
"""A suite of ``lrrt_bench`` shared by several machines: ``lrrt sweep``.

>>> from lrrt.sweep import Sweep, run_sweep
>>> run_sweep(Sweep("paper", "paper.json", shards=8), address="auto")  # doctest: +SKIP

``map_on_ray`` runs any function on many items in the same way. Only what runs on a cluster needs Ray
(``pip install "lrrt[sweep]"``).
"""

from lrrt.sweep.cluster import ClusterError, WorkerLostError, map_on_ray
from lrrt.sweep.errors import SweepError
from lrrt.sweep.merge import merge
from lrrt.sweep.running import Sweep, finished_shards, run_sweep

__all__ = [
    "ClusterError",
    "Sweep",
    "SweepError",
    "WorkerLostError",
    "finished_shards",
    "map_on_ray",
    "merge",
    "run_sweep",
]
