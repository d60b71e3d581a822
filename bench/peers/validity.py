# SPDX-License-Identifier: BSD-3-Clause
"""The library's exact collision check, once more in plain Python: it is called from planners of another package.

Pixel (c, r) covers [c, c+1) × [r, r+1). A segment is free only if every pixel that it touches is free; where it passes
through the common corner of four pixels all of them must be free.
"""

from __future__ import annotations

from array import array
from pathlib import Path

import numpy as np
import numpy.typing as npt
from PIL import Image

_HAIR = 1e-9  # crossings nearer to a corner than this, in pixels, pass through it; the library's own width


class PictureError(ValueError):
    """A picture that is no map of free and blocked pixels; names the file and what was expected."""


def read_free(path: Path) -> npt.NDArray[np.bool_]:
    """(H, W), True where the picture is white.

    Raises:
        PictureError: it cannot be read, or has other colours than white (free) and black (blocked).
    """
    expected = "expected a picture that lrrt_bench --problems wrote: white is free, black is not"
    try:
        with Image.open(path) as picture:
            values = np.asarray(picture.convert("L"))
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError) as error:
        reason = getattr(error, "strerror", None) or error
        raise PictureError(f"{path}: cannot be read ({reason}); {expected}") from error
    other = values[(values != 0) & (values != 255)]
    if other.size:
        raise PictureError(f"{path}: has grey {other[0]}; {expected}")
    return values == 255


class SegmentCheck:
    """Exact check of points and straight motions on a map, in pixel coordinates (x right, y down).

    A segment is cut into its rows, or into its columns where it touches fewer of them, and every such piece is one
    look-up in a table that tells how far free pixels go on. No motion is sampled.
    """

    def __init__(self, free: npt.NDArray[np.bool_]) -> None:
        self._height, self._width = free.shape
        self._rows = _next_blocked(free)
        self._columns = _next_blocked(free.T)

    def is_inside(self, x: float, y: float) -> bool:
        """Whether a point lies on the map."""
        return 0.0 <= x < self._width and 0.0 <= y < self._height

    def is_free_point(self, x: float, y: float) -> bool:
        """Whether a point lies on a free pixel."""
        return 0.0 <= x < self._width and 0.0 <= y < self._height and self._rows[int(y)][int(x)] > int(x)

    def is_free(self, x0: float, y0: float, x1: float, y1: float) -> bool:
        """Whether a segment is free; points outside the map and points that are not numbers are not."""
        width, height = self._width, self._height
        if not (0.0 <= x0 < width and 0.0 <= x1 < width and 0.0 <= y0 < height and 0.0 <= y1 < height):
            return False
        if abs(y1 - y0) <= abs(x1 - x0):
            return _is_free(self._rows, x0, y0, x1, y1)
        return _is_free(self._columns, y0, x0, y1, x1)


def _next_blocked(free: npt.NDArray[np.bool_]) -> list[array[int]]:
    """For every pixel the first one of its row, from itself on, that is not free; the width where there is none."""
    width = free.shape[1]
    blocked = np.where(free, width, np.arange(width)).astype(np.intc)
    following = np.ascontiguousarray(np.minimum.accumulate(blocked[:, ::-1], axis=1)[:, ::-1])
    # Single elements of an array are read several times as fast as those of a NumPy array.
    return [array("i", row.tobytes()) for row in following]


def _is_free(following: list[array[int]], x0: float, y0: float, x1: float, y1: float) -> bool:
    """Walks row by row from the left end to the right one; every row's piece is one look-up."""
    if x1 < x0:
        x0, y0, x1, y1 = x1, y1, x0, y0
    first, last = int(x0), int(x1)
    row, end = int(y0), int(y1)
    left = first
    if row != end:
        slope = (x1 - x0) / (y1 - y0)
        step = 1 if row < end else -1
        line = row + (row < end)  # that the segment crosses next
        while row != end:
            crossing = x0 + (line - y0) * slope
            # A hair further on both sides: through a corner, the pieces of both rows touch the pixels around it. But
            # never beyond the ends: a segment that only begins or ends at a corner, or runs along the border between
            # two pixels, touches one side.
            right = int(crossing + _HAIR)
            if right > last:
                right = last
            if following[row][left] <= right:
                return False
            left = int(crossing - _HAIR)
            if left < first:
                left = first
            row += step
            line += step
    return following[end][left] > last
