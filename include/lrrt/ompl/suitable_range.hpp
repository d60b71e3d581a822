// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lrrt/ompl/map_validity.hpp"

namespace lrrt {

/// A range that suits a map: twice the mean clearance of its free pixels, so that motions fit its passages, and no less
/// than the paper's share of the map's side (6 of 256 pixels).
/// @return map units.
double suitable_range(const CollisionMap& map);

}  // namespace lrrt
