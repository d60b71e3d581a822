// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "lrrt/ompl/pose_validity.hpp"
#include "lrrt/plan.hpp"
#include "lrrt/stopwatch.hpp"
#include "problems.hpp"

namespace lrrt::bench {

/// A robot with an outline, ready for collision checks. @param map see planning_map().
std::shared_ptr<const CollisionBody> body_on(const OccupancyMap& map, const Polygon& outline);

/// Where a problem's robot starts and ends.
Pose2 start_of(const Problem& problem);
Pose2 goal_of(const Problem& problem);

/// The status of a problem at whose start or goal the robot touches something, or lies outside the map.
template <typename IsFree>
std::optional<PlanStatus> blocked_end(const Problem& problem, const IsFree& is_free) {
  const auto inside = [&](const Eigen::Vector2d& place) {
    return problem.map->contains(OccupancyMap::pixel_of(problem.map->to_pixel(place)));
  };
  if (!inside(problem.start)) return PlanStatus::start_outside;
  if (!inside(problem.goal)) return PlanStatus::goal_outside;
  if (!is_free(start_of(problem))) return PlanStatus::start_occupied;
  if (!is_free(goal_of(problem))) return PlanStatus::goal_occupied;
  return std::nullopt;
}

/// The clock of a rival of the library's planners, and its result. Times count from the making, limits from prepared().
class RivalRun {
 public:
  RivalRun(const PlanRow& row, CancelToken cancel) : row_(row), cancel_(std::move(cancel)) {}

  /// The search begins.
  void prepared() { prepare_ = watch_.total_ms(); }
  /// Whether time or patience is over.
  bool over() const { return cancel_.cancelled() || out_of_time(); }
  /// A run without a path. @param otherwise the status where neither clock nor caller ended it.
  PlanResult failed(PlanStatus otherwise, std::size_t iterations = 0) const;
  /// A run with one. @param headings empty in the plane.
  PlanResult solved(std::vector<Eigen::Vector2d> path, std::vector<double> headings, double cost,
                    std::size_t iterations = 0) const;

 private:
  bool out_of_time() const { return watch_.total_ms() > prepare_ + 1e3 * row_.options.time_limit; }
  PlanResult timed(std::size_t iterations) const;

  const PlanRow& row_;
  CancelToken cancel_;
  Stopwatch watch_;
  double prepare_ = 0.0;
};

}  // namespace lrrt::bench
