# SPDX-License-Identifier: BSD-3-Clause
"""Functions that workers of a test's cluster call."""

from __future__ import annotations

import os
from pathlib import Path

from lrrt.sweep.errors import SweepError


def square(number: int) -> int:
    return number**2


def dies_once(marker: str) -> str:
    """Takes its worker with it when it is called first."""
    if not Path(marker).exists():
        Path(marker).touch()
        os._exit(1)
    return "alive"


def always_dies(_: str) -> None:
    os._exit(1)


def refuses(number: int) -> int:
    raise SweepError(f"no {number}")
