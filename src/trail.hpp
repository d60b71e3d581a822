// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "lrrt/plan.hpp"

namespace lrrt {

/// A path in short pieces, of which some may be replaced.
class Trail {
 public:
  Trail() = default;
  /// @param reach what an angle costs where the robot turns on the spot, map units. @param spacing longest piece of a
  /// straight line in the plane, map units.
  Trail(const PlanResult& result, Motion motion, double reach, double spacing);

  bool empty() const { return poses_.empty(); }
  /// Number of poses; one more than pieces.
  std::size_t size() const { return poses_.size(); }
  const Pose2& pose(std::size_t i) const { return poses_[i]; }
  /// Cost from the first pose to pose i.
  double cost_to(std::size_t i) const { return cost_[i]; }
  double cost() const { return empty() ? 0.0 : cost_.back(); }
  /// The pose nearest to one. @param reach what an angle counts, map units.
  std::size_t nearest(const Pose2& pose, double reach) const;
  /// The first pose at which so much was spent; the last one where it never is.
  std::size_t at_cost(double cost) const;

  /// Appends poses first to last of another trail; where this one ends in the first of them, that one is not repeated.
  void append(const Trail& other, std::size_t first, std::size_t last);

  /// Writes path, headings and cost.
  void tell(Motion motion, PlanResult& result) const;

 private:
  void push(const Pose2& pose, bool told, double cost);

  std::vector<Pose2> poses_;
  std::vector<char> told_;  ///< 0 for a pose inside a straight line of the plane, which no result tells
  std::vector<double> cost_;
};

}  // namespace lrrt
