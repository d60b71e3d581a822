# SPDX-License-Identifier: BSD-3-Clause
"""Numbers and names as a report writes them; numbers are rounded as the benchmark program rounds them."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

from lrrt.report.statistics import summarize

THIN_SPACE = "\u202f"  #: between thousands; a line does not break there


def short_number(value: float) -> str:
    """Three digits or all before the point, thousands apart; ``-`` for nan."""
    if math.isnan(value):
        return "-"
    if math.isinf(value):
        return "inf" if value > 0 else "-inf"
    size = abs(value)
    if size >= 99.95:
        return plain_number(math.copysign(math.floor(size + 0.5), value))
    if size < 0.1:
        return f"{value:.2g}"
    return f"{value:.{1 if size >= 9.995 else 2 if size >= 0.9995 else 3}f}"


def plain_number(value: float) -> str:
    """All digits of a number, thousands apart from five digits on."""
    return f"{value:,.12g}".replace(",", THIN_SPACE if abs(value) >= 10_000 else "")


def median_and_quartiles(values: Sequence[float], unit: str = "") -> str:
    """As in ``3.1 [2.0, 4.5]``; ``-`` of none."""
    if not len(values):
        return "-"
    s = summarize(values)
    return f"{short_number(s.median)}{unit} [{short_number(s.lower)}, {short_number(s.upper)}]"


def mean_and_deviation(values: Sequence[float]) -> str:
    """As in ``3.1 ± 0.4``; ``-`` of none."""
    if not len(values):
        return "-"
    s = summarize(values)
    return f"{short_number(s.mean)} ± {short_number(s.deviation)}"


def slug(text: str) -> str:
    """A text as part of a file's name: small letters, digits and hyphens."""
    return re.sub(r"[^a-z0-9]+", "-", text.lower().replace("×", "x")).strip("-")[:60] or "unnamed"


def counted(count: int, one: str, many: str) -> str:
    """As in ``1 run`` and ``3 runs``."""
    return f"{count} {one if count == 1 else many}"
