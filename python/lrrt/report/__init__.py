# SPDX-License-Identifier: BSD-3-Clause
"""Result files of ``lrrt_bench`` as one page with figures and tables: ``lrrt report``.

>>> from lrrt.report import write_report
>>> write_report(["paper.json"], "report.html")  # doctest: +SKIP
"""

from lrrt.report.fields import ResultError
from lrrt.report.results import PlanResults, PredictResults, load
from lrrt.report.terminal import terminal_report
from lrrt.report.writing import write_report

__all__ = ["PlanResults", "PredictResults", "ResultError", "load", "terminal_report", "write_report"]
