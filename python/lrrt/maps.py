# SPDX-License-Identifier: BSD-3-Clause
"""Maps from files."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import numpy.typing as npt

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
    return read_map_with_sources(path)[0]


def read_map_with_sources(path: str | os.PathLike[str]) -> tuple[OccupancyMap, list[Path]]:
    """As ``read_map``, with the files that were read: the given one and, of a map_server map, its picture."""
    sources = [Path(path)]

    def decode(picture: str) -> npt.NDArray[np.uint8]:
        sources.append(Path(picture))
        return decode_picture(picture)

    return _core.read_map(os.fspath(path), decode), sources
