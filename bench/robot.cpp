// SPDX-License-Identifier: BSD-3-Clause
#include "robot.hpp"

#include <utility>
#include <vector>

#include "lrrt/map/footprint.hpp"

namespace lrrt::bench {

std::optional<Polygon> outline_at(const PlanSuite& suite, double scale) {
  if (!suite.outline) return std::nullopt;
  std::vector<Eigen::Vector2d> corners = suite.outline->vertices();
  for (Eigen::Vector2d& corner : corners) corner *= scale;
  return Polygon(std::move(corners));
}

PlanRequest request_of(const Problem& problem, const PlanSuite& suite, const PlanRow& row, const CancelToken& cancel) {
  PlanRequest request{*problem.map, problem.start, problem.goal, suite.radius * problem.scale, suite.unknown, cancel};
  request.outline = outline_at(suite, problem.scale);
  request.motion = motion_from_string(row.motion);
  request.turning_radius = row.turning_radius * problem.scale;
  request.start_heading = problem.start_heading;
  request.goal_heading = problem.goal_heading;
  return request;
}

OccupancyMap planning_map(const OccupancyMap& map, const PlanSuite& suite, double scale) {
  return inflated(map.resolved(suite.unknown), suite.radius * scale);
}

OccupancyMap planning_map(const Problem& problem, const PlanSuite& suite) {
  return planning_map(*problem.map, suite, problem.scale);
}

}  // namespace lrrt::bench
