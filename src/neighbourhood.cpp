// SPDX-License-Identifier: BSD-3-Clause
#include "neighbourhood.hpp"

#include <algorithm>
#include <limits>

#include "steps.hpp"

namespace lrrt {
namespace {

/// When to give up: a way that is near by is found soon, and planning it all anew takes not much longer.
constexpr double most_seconds = 0.05;
constexpr std::size_t most_iterations = 500;

/// The part of a map inside a box and what a robot needs around it.
OccupancyMap part_of(const PlanRequest& robot, const PixelBox& box) {
  const OccupancyMap& map = robot.map.get();
  const PixelBox wide = widened(box, 2.0 + reach_of(robot) / map.resolution());
  return map.cropped(clipped(wide, map.width(), map.height()));
}

/// The request on a part of its map. The part must outlive it.
PlanRequest moved(PlanRequest request, const OccupancyMap& part) {
  request.map = part;
  return request;
}

}  // namespace

double reach_of(const PlanRequest& robot) {
  return robot.radius + (robot.outline ? robot.outline->circumscribed_radius() : 0.0);
}

Neighbourhood::Neighbourhood(const PlanRequest& robot, const PixelBox& box)
    : part_(part_of(robot, box)), robot_(moved(robot, part_)), space_(robot_, std::numeric_limits<int>::max()) {}

bool Neighbourhood::is_free(const Pose2& from, const Pose2& to) {
  return space_.is_free(robot_, from, to);
}

std::optional<PlanResult> Neighbourhood::plan(const Pose2& from, const Pose2& to, const PlanOptions& options,
                                              const CancelToken& cancel) {
  PlanOptions near;
  near.planner = robot_.motion == Motion::dubins ? "RRT" : "RRTConnect";  // trees seldom meet that only grow forwards
  near.strategy = Strategy::uniform;
  near.seed = options.seed;
  near.time_limit = std::min(options.time_limit, most_seconds);
  near.iteration_limit = most_iterations;
  near.simplify = true;
  PlanRequest request = robot_;
  request.start = {from.x, from.y};
  request.goal = {to.x, to.y};
  request.start_heading = from.yaw;
  request.goal_heading = to.yaw;
  request.cancel = cancel;
  PlanResult result;
  if (const std::optional<Prepared> prepared = look(space_, request, near, result)) {
    search(*prepared, request, near, result);
  }
  if (!result.solved()) return std::nullopt;
  return result;
}

}  // namespace lrrt
