// SPDX-License-Identifier: BSD-3-Clause
#include "replanning.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lrrt/map/shortest_path.hpp"
#include "lrrt/ompl/pose_validity.hpp"
#include "lrrt/session.hpp"
#include "lrrt/stopwatch.hpp"
#include "robot.hpp"

namespace lrrt::bench {
namespace {

/// The pose of a path after so much of its length, map units.
Pose2 along(const PlanResult& result, double distance) {
  const auto pose = [&](std::size_t i, const Eigen::Vector2d& at) {
    return Pose2{at.x(), at.y(), result.headings.empty() ? 0.0 : result.headings[i]};
  };
  for (std::size_t i = 1; i < result.path.size(); ++i) {
    const Eigen::Vector2d step = result.path[i] - result.path[i - 1];
    const double length = step.norm();
    // poses lie so close that the next one will do
    if (distance < length)
      return pose(i, result.headings.empty() ? result.path[i - 1] + step * (distance / length) : result.path[i]);
    distance -= length;
  }
  return pose(result.path.size() - 1, result.path.back());
}

bool fits(const PlanRequest& request, const PlanSuite& suite, double scale, const Pose2& pose) {
  const OccupancyMap map = planning_map(request.map, suite, scale);
  if (!request.outline) return map.is_free(OccupancyMap::pixel_of(map.to_pixel({pose.x, pose.y})));
  return CollisionBody(std::make_shared<const CollisionMap>(map), *request.outline).is_free(pose);
}

/// Where the robot is after a while: on its path, but for a pixel to the side where it fits there.
Pose2 moved(const PlanRequest& request, const PlanSuite& suite, double scale, const PlanResult& before) {
  const Pose2 on_path = along(before, suite.move * scale);
  const Pose2 beside{on_path.x + request.map.get().resolution(), on_path.y, on_path.yaw};
  return fits(request, suite, scale, beside) ? beside : on_path;
}

/// The map with a square obstacle.
OccupancyMap with_square(const OccupancyMap& map, const Pose2& middle, double side) {
  const Pixel centre = OccupancyMap::pixel_of(map.to_pixel({middle.x, middle.y}));
  const int reach = std::max(0, static_cast<int>(std::lround(0.5 * side / map.resolution() - 0.5)));
  std::vector<Cell> cells = map.cells();
  for (int r = centre.r - reach; r <= centre.r + reach; ++r) {
    for (int c = centre.c - reach; c <= centre.c + reach; ++c) {
      if (map.contains({c, r})) cells[map.index({c, r})] = Cell::occupied;
    }
  }
  return map.with_cells(std::move(cells));
}

}  // namespace

PlanResult replanned(const PlanRequest& request, const PlanSuite& suite, const PlanRow& row,
                     const std::shared_ptr<const RegionPredictor>& predictor, double scale) {
  const Planner planner(predictor, row.options);
  Session session(planner, request);
  PlanResult before =
      session.plan({request.start, request.goal, request.start_heading, request.goal_heading}, request.cancel);
  if (!before.solved()) return before;

  PlanRequest again = request;
  OccupancyMap map = request.map;
  if (row.after == "move") {
    const Pose2 pose = moved(request, suite, scale, before);
    again.start = {pose.x, pose.y};
    again.start_heading = pose.yaw;
  } else {
    map = with_square(map, along(before, 0.5 * path_length(before.path)), suite.obstacle * scale);
  }
  again.map = map;
  if (!row.session) return planner.plan(again);

  const Stopwatch watch;
  if (row.after == "obstacle") session.update(map);
  const double update = watch.total_ms();
  PlanResult result = session.replan(again.start, again.start_heading, request.cancel);
  result.timings.prepare += update;
  result.timings.total += update;
  return result;
}

}  // namespace lrrt::bench
