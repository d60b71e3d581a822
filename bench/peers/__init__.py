# SPDX-License-Identifier: BSD-3-Clause
"""Planners outside this project's C++, on the queries of ``lrrt_bench``: those of the PyPI package ``ompl``.

``python bench/peers/run.py --help`` says how; ``docs/benchmarks.md`` what the numbers mean.
"""
