// SPDX-License-Identifier: BSD-3-Clause
#include "trail.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lrrt/ompl/map_projection.hpp"
#include "lrrt/ompl/pose_motion.hpp"

namespace lrrt {
namespace {

double apart(const Pose2& a, const Pose2& b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}

/// What a short piece of a path costs: a straight line, or one arc.
double piece_cost(const Pose2& a, const Pose2& b, Motion motion, double reach) {
  if (motion == Motion::plane) return apart(a, b);
  if (motion == Motion::turning) return apart(a, b) + reach * angle_between(a.yaw, b.yaw);
  return std::abs(arc_length(a, b));
}

}  // namespace

Trail::Trail(const PlanResult& result, Motion motion, double reach, double spacing) {
  const bool flat = motion == Motion::plane;
  for (std::size_t i = 0; i < result.path.size(); ++i) {
    const Pose2 next{result.path[i].x(), result.path[i].y(), flat ? 0.0 : result.headings[i]};
    if (i == 0) {
      push(next, true, 0.0);
      continue;
    }
    const Pose2 last = poses_.back();
    const int pieces = flat ? std::max(1, static_cast<int>(std::ceil(apart(last, next) / spacing))) : 1;
    for (int k = 1; k < pieces; ++k) {
      const double t = static_cast<double>(k) / pieces;
      const Pose2 between{last.x + t * (next.x - last.x), last.y + t * (next.y - last.y), 0.0};
      push(between, false, apart(poses_.back(), between));
    }
    push(next, true, piece_cost(poses_.back(), next, motion, reach));
  }
}

void Trail::push(const Pose2& pose, bool told, double cost) {
  cost_.push_back(empty() ? 0.0 : cost_.back() + cost);
  poses_.push_back(pose);
  told_.push_back(static_cast<char>(told));
}

std::size_t Trail::nearest(const Pose2& pose, double reach) const {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < size(); ++i) {
    const double distance = apart(poses_[i], pose) + reach * angle_between(poses_[i].yaw, pose.yaw);
    if (distance >= least) continue;
    least = distance;
    best = i;
  }
  return best;
}

std::size_t Trail::at_cost(double cost) const {
  const auto found = std::lower_bound(cost_.begin(), cost_.end(), cost);
  return std::min(static_cast<std::size_t>(found - cost_.begin()), size() - 1);
}

void Trail::append(const Trail& other, std::size_t first, std::size_t last) {
  if (!empty()) told_.back() = 1;  // a part of another path begins here
  for (std::size_t i = first; i <= last; ++i) {
    if (i == first && !empty()) continue;
    push(other.poses_[i], other.told_[i] != 0 || i == first || i == last,
         i == first ? 0.0 : other.cost_[i] - other.cost_[i - 1]);
  }
}

void Trail::tell(Motion motion, PlanResult& result) const {
  result.path.clear();
  result.headings.clear();
  const auto add = [&](const Pose2& pose) {
    result.path.emplace_back(pose.x, pose.y);
    if (motion != Motion::plane) result.headings.push_back(pose.yaw);
  };
  for (std::size_t i = 0; i < size(); ++i) {
    if (told_[i] != 0) add(poses_[i]);
  }
  if (size() == 1) add(poses_.front());  // a path has two ends, also where they coincide
  result.cost = cost();
}

}  // namespace lrrt
