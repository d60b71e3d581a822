// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lrrt/map/occupancy_map.hpp"
#include "lrrt/map/polygon.hpp"
#include "lrrt/sampling/random.hpp"

namespace lrrt::test {

/// The shorter way from one angle to another, radians, never negative.
double angle_between(double a, double b);

/// Independent of the library's checks: true when a polygon at a pose reaches into a pixel that is not free, or off the
/// map, by more than a hair. Polygon against pixel by separating axes for every triangle of a fan, so the polygon has
/// to be convex.
bool overlaps_blocked(const OccupancyMap& map, const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& at,
                      double heading);

/// A pose at which the robot fits; anything after many tries.
Pose2 random_pose(const OccupancyMap& map, const Polygon& robot, Random& random);

/// Not too crowded a map of 60×50 pixels, in metres with an origin and a yaw if asked for.
OccupancyMap random_room(Random& random, bool metric);

}  // namespace lrrt::test
