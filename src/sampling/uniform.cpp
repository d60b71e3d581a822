// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/sampling/uniform.hpp"

#include <algorithm>
#include <cmath>

namespace lrrt {
namespace {

/// Tries before a point is taken as it comes: an ellipse may lie almost wholly outside the map's free part, never
/// outside the map.
constexpr int most_tries = 100;
constexpr double tau = 6.283185307179586;

}  // namespace

Eigen::Vector2d UniformStrategy::draw_from_map(Random& random) const {
  const double x = random.uniform(0.0, width_);
  return {x, random.uniform(0.0, height_)};
}

Eigen::Vector2d UniformStrategy::draw_from_ellipse(Random& random) const {
  const double radius = std::sqrt(random.uniform());
  const double angle = random.uniform(0.0, tau);
  return 0.5 * (focus_ + other_focus_) + radius * (std::cos(angle) * half_major_ + std::sin(angle) * half_minor_);
}

Eigen::Vector2d UniformStrategy::draw(Random& random) const {
  if (!informed_) return draw_from_map(random);
  const bool small = half_major_.norm() * half_minor_.norm() * tau / 2.0 < width_ * height_;
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  for (int i = 0; i < most_tries; ++i) {
    point = small ? draw_from_ellipse(random) : draw_from_map(random);
    const bool inside = point.x() >= 0.0 && point.y() >= 0.0 && point.x() < width_ && point.y() < height_;
    if (inside && could_improve(point)) return point;
  }
  return point;
}

Eigen::Vector2d UniformStrategy::draw_near(const Eigen::Vector2d& centre, double reach, Random& random) const {
  const auto along = [&](double middle, double side) {
    return random.uniform(std::clamp(middle - reach, 0.0, side), std::clamp(middle + reach, 0.0, side));
  };
  const double x = along(centre.x(), width_);
  return {x, along(centre.y(), height_)};
}

void UniformStrategy::inform(const Eigen::Vector2d& start, const Eigen::Vector2d& goal, double length) {
  informed_ = true;
  focus_ = start;
  other_focus_ = goal;
  const Eigen::Vector2d axis = goal - start;
  const double apart = axis.norm();
  length_ = std::max(apart, length);
  const Eigen::Vector2d along = apart > 0.0 ? Eigen::Vector2d(axis / apart) : Eigen::Vector2d(1.0, 0.0);
  half_major_ = 0.5 * length_ * along;
  half_minor_ = 0.5 * std::sqrt(length_ * length_ - apart * apart) * Eigen::Vector2d(-along.y(), along.x());
}

}  // namespace lrrt
