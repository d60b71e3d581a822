# SPDX-License-Identifier: BSD-3-Clause
"""Maps from files."""

from __future__ import annotations

import os

from lrrt import _core
from lrrt._core import OccupancyMap
from lrrt.pictures import decode_picture


def read_map(path: str | os.PathLike[str]) -> OccupancyMap:
    """Reads a map of any supported kind.

    - ``.yaml``, ``.yml``: ROS map_server (modes trinary, scale, raw); map units are metres, y up.
    - ``.map`` that begins with ``type``: MovingAI; map units are pixels, x right, y down.
    - anything else: a picture (PNG, PGM, PPM, PBM, BMP, JPEG), dark is occupied; map units are pixels.

    Raises:
        MapError: names the file and what is wrong with it.
    """
    return _core.read_map(os.fspath(path), decode_picture)
