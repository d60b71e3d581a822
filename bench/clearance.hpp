// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lrrt/map/occupancy_map.hpp"

namespace lrrt::bench {

/// How far a path stays from what is not free, map units.
struct Clearance {
  double least = 0.0;
  double mean = 0.0;  ///< along the path's length
};

/// Clearance of a path, asked for at steps of half a pixel; distances are those of DistanceField, from pixel centre to
/// pixel centre.
/// @param map that a point plans on, so that obstacles are grown by the robot's radius. @param path map units; an empty
/// one has none.
Clearance clearance_of(const OccupancyMap& map, const std::vector<Eigen::Vector2d>& path);

}  // namespace lrrt::bench
