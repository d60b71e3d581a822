// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "lrrt/map/occupancy_map.hpp"

namespace lrrt {

/// A map as it is now, and where it differs from what it was.
struct MapChanges {
  OccupancyMap map;
  std::vector<PixelBox> boxes;  ///< hold every pixel that changed; none when nothing did
};

/// Lays a part over a map.
/// @throws MapError when their resolutions differ, their pixels do not coincide or the part leaves the map.
MapChanges changes_between(const OccupancyMap& map, const OccupancyMap& part);

}  // namespace lrrt
