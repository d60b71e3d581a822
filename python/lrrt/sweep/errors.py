# SPDX-License-Identifier: BSD-3-Clause
"""What can go wrong in a sweep."""

from __future__ import annotations

from lrrt._core import Error


class SweepError(Error):
    """A sweep cannot be run, continued or merged; names the shard or file and what was expected."""


class ShardInterruptedError(SweepError):
    """The benchmark program was ended by something outside; the shard may be tried again."""
