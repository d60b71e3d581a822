// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lrrt/map/occupancy_map.hpp"

namespace lrrt {

/// The map in which a disc becomes a point: a pixel stays free when a disc centred anywhere in it touches no pixel that
/// is not free and does not leave the map. Planning a point in the result is safe for the disc; it is conservative by
/// less than a pixel's diagonal, since it asks the worst point of each pixel.
/// @param radius map units, zero or more; 0 returns the map unchanged.
/// @throws RequestError when the radius is negative or not finite.
OccupancyMap inflated(OccupancyMap map, double radius);

}  // namespace lrrt
