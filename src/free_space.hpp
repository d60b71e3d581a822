// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "lrrt/ompl/pose_validity.hpp"
#include "lrrt/plan.hpp"
#include "room.hpp"

namespace lrrt {

/// A request made ready for a search.
struct Prepared {
  std::optional<PlanStatus> hopeless;            ///< what can be said without a search; nothing when one is worth it
  bool arrived = false;                          ///< the goal is reached at the start
  std::shared_ptr<const CollisionMap> map;       ///< where the reference point may be; null when hopeless or arrived
  std::shared_ptr<const OccupancyMap> guidance;  ///< the same, in pixels as large as the detail allows
  std::shared_ptr<const CollisionBody> body;     ///< the robot of a pose space; null in the plane and when hopeless
  double reach = 0.0;                            ///< see pose_space()
};

/// What a robot can reach on a map: everything that does not change from query to query. Parts are made when they are
/// first asked for, and kept. Not for concurrent use.
class FreeSpace {
 public:
  /// Resolves unknown pixels and grows obstacles by the robot's radius.
  /// @param request its map and its robot; start and goal do not matter.
  /// @param detail longest side, pixels, of the maps that guidance asks for.
  FreeSpace(const PlanRequest& request, int detail);

  /// Looks at start and goal.
  /// @param request a query for the same robot on the same map. @param options of which the tolerances count.
  Prepared prepare(const PlanRequest& request, const PlanOptions& options);
  /// True when the robot of the request touches nothing along a straight line or, where it drives on them, along the
  /// one arc from pose to pose.
  bool is_free(const PlanRequest& request, const Pose2& from, const Pose2& to);

 private:
  Prepared prepare_plane(const PlanRequest& request, double goal_tolerance);
  Prepared prepare_poses(const PlanRequest& request, const PlanOptions& options);
  const std::shared_ptr<const CollisionBody>& body(const PlanRequest& request);
  /// The room of the disc that the outline holds, and the map on which it joins start and goal; null when none does.
  Room* joining_room(const PlanRequest& request, std::shared_ptr<const OccupancyMap>& guidance);

  int detail_;
  Room grown_;                  ///< for the radius alone
  std::optional<Room> inside_;  ///< for the disc inside the outline too, anywhere in a pixel
  std::optional<Room> closed_;  ///< the same but for pixels that are surely closed
  std::shared_ptr<const CollisionBody> body_;
};

/// The range for a request that leaves it to the map, map units.
double default_range(const Prepared& prepared, const PlanRequest& request);

/// A point and a heading as a pose with its heading in [-π, π).
Pose2 pose(const Eigen::Vector2d& point, double heading);

}  // namespace lrrt
