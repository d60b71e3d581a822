// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/SpaceInformation.h>

#include <functional>
#include <memory>
#include <vector>

#include "lrrt/ompl/map_projection.hpp"
#include "lrrt/ompl/map_validity.hpp"
#include "lrrt/ompl/pose_validity.hpp"
#include "lrrt/ompl/search_limits.hpp"
#include "lrrt/plan.hpp"

namespace lrrt {

/// A path as it is handed out, map units and radians.
struct Trace {
  std::vector<Eigen::Vector2d> points;  ///< from start to goal
  std::vector<double> headings;         ///< one for each point; empty in the plane
};

/// The space that a search moves in: what a MapSearch has to know of the robot.
struct SearchSpace {
  std::shared_ptr<const CollisionMap> map;          ///< where the robot's reference point may be
  std::shared_ptr<const MapProjection> projection;  ///< how states touch the map
  ompl::base::SpaceInformationPtr si;               ///< set up, with the checks of states and motions
  /// Appends a motion to a trace, all of it but its first pose. @return false, and nothing appended, where the motion
  /// is free in neither direction; one way only counts where a motion back would be another one.
  std::function<bool(const ompl::base::State* from, const ompl::base::State* to, Trace& trace)> follow;
};

/// The plane of a map for a point. @param limits see MapMotionValidator.
SearchSpace plane_space(const std::shared_ptr<const CollisionMap>& map, const std::shared_ptr<SearchLimits>& limits);

/// The poses of a robot with a body. @param map where its reference point may be: with its obstacles grown by what it
/// needs at least. @param motion not plane. @param turning_radius map units, see PlanRequest.
/// @param reach distance from the reference point to the robot's farthest point, above 0, map units: what an angle
/// counts beside a length where the robot may turn on the spot, and how densely a path is told.
SearchSpace pose_space(const std::shared_ptr<const CollisionMap>& map, const std::shared_ptr<const CollisionBody>& body,
                       Motion motion, double turning_radius, double reach, const std::shared_ptr<SearchLimits>& limits);

}  // namespace lrrt
