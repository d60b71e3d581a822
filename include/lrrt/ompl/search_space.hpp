// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/Path.h>
#include <ompl/base/SpaceInformation.h>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "lrrt/ompl/clearance_objective.hpp"
#include "lrrt/ompl/drive_space.hpp"
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
  std::vector<Control> controls;        ///< of a driven robot
  double cost = 0.0;                    ///< as PlanResult::cost
};

/// What a search has to know of a driven robot.
struct Driver {
  Drive drive;                                        ///< its limits
  std::shared_ptr<const DrivePropagator> propagator;  ///< what checks its motions
};

/// The space that a search moves in: what a MapSearch has to know of the robot.
struct SearchSpace {
  std::shared_ptr<const CollisionMap> map;          ///< where the robot's reference point may be
  std::shared_ptr<const MapProjection> projection;  ///< how states touch the map
  ompl::base::SpaceInformationPtr si;               ///< set up, with the checks of states and motions
  ompl::base::OptimizationObjectivePtr objective;   ///< what a path costs
  /// Tells a path of the planner, checked once more. @return nothing where a motion of it is free in neither direction;
  /// one way only counts where a motion back would be another one.
  std::function<std::optional<Trace>(const ompl::base::Path& path)> tell;
  std::optional<Driver> driver{};  ///< of a driven robot, whose planners and paths are those of ompl::control
};

/// The plane of a map for a point. @param clearance that paths shall keep. @param limits see MapMotionValidator.
SearchSpace plane_space(const std::shared_ptr<const CollisionMap>& map, const ClearanceCost& clearance,
                        const std::shared_ptr<SearchLimits>& limits);

/// The poses of a robot with a body. @param map where its reference point may be: with its obstacles grown by what it
/// needs at least. @param motion not plane. @param turning_radius map units, see PlanRequest.
/// @param reach distance from the reference point to the robot's farthest point, above 0, map units: what an angle
/// counts beside a length where the robot may turn on the spot, and how densely a path is told.
SearchSpace pose_space(const std::shared_ptr<const CollisionMap>& map, const std::shared_ptr<const CollisionBody>& body,
                       Motion motion, double turning_radius, double reach, const ClearanceCost& clearance,
                       const std::shared_ptr<SearchLimits>& limits);

/// The same for a driven robot. @param range map units: no control lasts longer than this takes at full speed.
/// @param seed of its random controls, not 0.
SearchSpace drive_space(const std::shared_ptr<const CollisionMap>& map,
                        const std::shared_ptr<const CollisionBody>& body, const Drive& drive, double range,
                        double reach, std::uint32_t seed, const std::shared_ptr<SearchLimits>& limits);

}  // namespace lrrt
