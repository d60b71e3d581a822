// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "lrrt/ompl/pose_validity.hpp"
#include "lrrt/plan.hpp"
#include "problems.hpp"

namespace lrrt::bench {

/// What a row calls the grid search for cars, where planners have their names.
inline constexpr const char* hybrid_search_name = "HybridA*";

/// A car's way: poses between which no point of it moves farther than a pixel.
struct CarWay {
  std::vector<Pose2> poses;  ///< from start to goal, exactly; empty where none was found
  double length = 0.0;       ///< of the arcs and straight lines, map units
};

/// A search over a grid of places and headings for a car, Hybrid A* (Dolgov, Thrun, Montemerlo, Diebel 2008).
///
/// From each pose lead the two tightest arcs and the straight line, for a car that reverses backwards too; of the poses
/// in one cell, a place of a fifth of the turning radius (at least a pixel) at one of 24 headings, the first one
/// counts. The order is by the length so far and twice the walking distance that is left, so that a way comes soon
/// rather than the shortest one. From some poses OMPL's shortest curve to the goal is tried, so the way ends exactly
/// there. A way that it finds is free; where it finds none, a finer grid might.
class HybridSearch {
 public:
  /// @param body the robot on a map, see planning_map().
  /// @param motion dubins or reeds_shepp. @param turning_radius map units.
  /// @throws SuiteError when the turning radius is less than a quarter of a pixel or more than a million of them.
  HybridSearch(std::shared_ptr<const CollisionBody> body, Motion motion, double turning_radius);

  /// Where the disc that the robot holds fits anywhere in a pixel; once all of that is tried, where it may fit
  /// somewhere.
  /// @param start,goal poses at which the robot touches nothing.
  /// @param ended asked at every pose that is tried: whether to give up.
  CarWay find(const Pose2& start, const Pose2& goal, const std::function<bool()>& ended) const;

 private:
  friend class HybridRun;

  std::shared_ptr<const CollisionBody> body_;
  bool reverse_;
  double radius_;
  std::shared_ptr<ompl::base::StateSpace> space_;
  Steering steering_;
};

/// The rival of guided planners for cars: all of it but reading the map counts, as for them. Where the grid is
/// exhausted the status is iteration_limit.
PlanResult hybrid_search(const Problem& problem, const PlanSuite& suite, const PlanRow& row, const CancelToken& cancel);

}  // namespace lrrt::bench
