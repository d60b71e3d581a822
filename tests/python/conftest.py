# SPDX-License-Identifier: BSD-3-Clause
"""Maps that several tests share."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import settings

import lrrt

# How long an example takes says more about the machine than about the code.
settings.register_profile("lrrt", deadline=None)
settings.load_profile("lrrt")


@pytest.fixture
def hall() -> lrrt.OccupancyMap:
    """40×60 free pixels, a wall with a door, an unknown corner, a closed room."""
    cells = np.zeros((40, 60), dtype=np.uint8)
    cells[:30, 30] = 1
    cells[:4, :4] = 2
    cells[10:20, 45:55] = 1
    cells[12:18, 47:53] = 0
    return lrrt.OccupancyMap.from_array(cells)


@pytest.fixture(scope="session")
def predictor() -> lrrt.OnnxPredictor:
    return lrrt.default_predictor()
