# SPDX-License-Identifier: BSD-3-Clause
"""The statistics of the benchmark program (``bench/statistics.cpp``), so that a report says what the program said."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

_Z = 1.959963984540054  # of the normal distribution, 95 % two-sided


@dataclass(frozen=True)
class Summary:
    """What a set of measurements amounts to; nan where there are too few of them."""

    count: int
    median: float
    lower: float  #: first quartile
    upper: float  #: third quartile
    mean: float
    deviation: float  #: sample standard deviation; needs two values


def quantile(values: Sequence[float] | npt.NDArray[np.float64], share: float) -> float:
    """Quantile, interpolated linearly between neighbours (Hyndman and Fan 1996, type 7); nan of none."""
    return float(np.quantile(values, share)) if len(values) else math.nan


def summarize(values: Sequence[float]) -> Summary:
    """Median, quartiles, mean and deviation."""
    lower, median, upper = (quantile(values, share) for share in (0.25, 0.5, 0.75))
    mean = float(np.mean(values)) if len(values) else math.nan
    deviation = float(np.std(values, ddof=1)) if len(values) > 1 else math.nan
    return Summary(len(values), median, lower, upper, mean, deviation)


def wilson_interval(successes: int, trials: int) -> tuple[float, float]:
    """Wilson's score interval of a success rate (Wilson 1927), 95 %; 0 to 1 where nothing was tried."""
    if trials == 0:
        return 0.0, 1.0
    rate = successes / trials
    scale = 1.0 + _Z**2 / trials
    middle = (rate + _Z**2 / (2 * trials)) / scale
    half = _Z * math.sqrt(rate * (1 - rate) / trials + _Z**2 / (4 * trials**2)) / scale
    return max(0.0, middle - half), min(1.0, middle + half)


def ratios(pairs: Iterable[tuple[float, float]]) -> list[float]:
    """The first number of each pair divided by the second, where that is a finite number."""
    quotients = (a / b for a, b in pairs if b != 0)
    return [quotient for quotient in quotients if math.isfinite(quotient)]
