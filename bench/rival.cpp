// SPDX-License-Identifier: BSD-3-Clause
#include "rival.hpp"

#include <utility>

namespace lrrt::bench {

std::shared_ptr<const CollisionBody> body_on(const OccupancyMap& map, const Polygon& outline) {
  return std::make_shared<const CollisionBody>(std::make_shared<const CollisionMap>(map), outline);
}

Pose2 start_of(const Problem& problem) {
  return {problem.start.x(), problem.start.y(), problem.start_heading};
}

Pose2 goal_of(const Problem& problem) {
  return {problem.goal.x(), problem.goal.y(), problem.goal_heading};
}

PlanResult RivalRun::timed(std::size_t iterations) const {
  PlanResult result;
  result.timings.prepare = prepare_;
  result.timings.total = watch_.total_ms();
  result.timings.plan = result.timings.total - prepare_;
  result.iterations = iterations;
  return result;
}

PlanResult RivalRun::failed(PlanStatus otherwise, std::size_t iterations) const {
  PlanResult result = timed(iterations);
  result.status = cancel_.cancelled() ? PlanStatus::cancelled : out_of_time() ? PlanStatus::time_limit : otherwise;
  return result;
}

PlanResult RivalRun::solved(std::vector<Eigen::Vector2d> path, std::vector<double> headings, double cost,
                            std::size_t iterations) const {
  PlanResult result = timed(iterations);
  result.status = PlanStatus::solved;
  result.path = std::move(path);
  result.headings = std::move(headings);
  result.cost = cost;
  result.cost_history = {{result.timings.plan, iterations, cost}};
  return result;
}

}  // namespace lrrt::bench
