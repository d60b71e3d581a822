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
/// in one cell, a place of about a tenth of the turning radius at one of 24 headings, the first one counts. The order
/// is by the length so far and the walking distance that is left. From some poses OMPL's shortest curve to the goal is
/// tried, so the way ends exactly there. A way that it finds is free; where it finds none, a finer grid might.
class HybridSearch {
 public:
  /// @param body the robot on the map. @param room the map in which its largest disc is a point.
  /// @param motion dubins or reeds_shepp. @param turning_radius map units.
  HybridSearch(std::shared_ptr<const CollisionBody> body, OccupancyMap room, Motion motion, double turning_radius);

  /// @param ended asked now and then with the number of poses tried so far: whether to give up.
  CarWay find(const Pose2& start, const Pose2& goal, const std::function<bool(std::size_t)>& ended) const;

 private:
  friend class HybridRun;

  std::shared_ptr<const CollisionBody> body_;
  OccupancyMap room_;
  bool reverse_;
  double radius_;
  std::shared_ptr<ompl::base::StateSpace> space_;
  Steering steering_;
};

/// The rival of guided planners for cars: all of it but reading the map counts, as for them.
PlanResult hybrid_search(const Problem& problem, const PlanSuite& suite, const PlanRow& row, const CancelToken& cancel);

}  // namespace lrrt::bench
