// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "lrrt/ompl/pose_validity.hpp"
#include "lrrt/plan.hpp"

namespace lrrt {

/// A request made ready for a search.
struct Prepared {
  std::optional<PlanStatus> hopeless;         ///< what can be said without a search; nothing when one is worth it
  bool arrived = false;                       ///< the goal is reached at the start
  std::shared_ptr<const CollisionMap> map;    ///< where the reference point may be; null when hopeless
  std::shared_ptr<const CollisionBody> body;  ///< the robot of a pose space; null in the plane and when hopeless
  double reach = 0.0;                         ///< see pose_space()
};

/// Resolves unknown pixels, grows obstacles by what the robot needs, and looks at start and goal.
/// @param goal_tolerance map units.
Prepared prepare(const PlanRequest& request, double goal_tolerance);

/// The range for a request that leaves it to the map, map units.
double default_range(const Prepared& prepared, const PlanRequest& request);

/// A point and a heading as a pose with its heading in [-π, π).
Pose2 pose(const Eigen::Vector2d& point, double heading);

}  // namespace lrrt
