// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "lrrt/map/occupancy_map.hpp"

namespace lrrt::bench {

/// More corners than this in question, and the search would take minutes and gigabytes.
inline constexpr std::size_t most_corners = 5000;

/// Length of the shortest path of a point among a map's pixels: the exact optimum (an infimum: it may touch corners)
/// that any planner under the library's rule can approach, up to 1e-4 pixels.
///
/// A shortest path turns only at convex corners of obstacles (Lozano-Pérez and Wesley 1979). A* over these corners,
/// each a hair inside free space, with SegmentWalk as the visibility check, edges checked only when they come up
/// (Bohlin and Kavraki 2000). Corners that no path of the length already known can visit are left out: an 8-neighbour
/// path along pixel corners is at most 1.0824 times as long as the shortest one (Bailey et al. 2015), which bounds it
/// from below.
/// @param map resolved and inflated: the map that the point plans on. @param start,goal map units.
/// @return map units; infinite when there is no path, NaN where more than most_corners would have to be looked at.
double shortest_length(const OccupancyMap& map, const Eigen::Vector2d& start, const Eigen::Vector2d& goal);

}  // namespace lrrt::bench
