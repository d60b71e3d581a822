// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "lrrt/sampling/random.hpp"

namespace lrrt {

/// Every point of the map with the same density; once a path is known, if asked for, every point that could shorten it:
/// those of an ellipse with start and goal as foci (Gammell, Srinivasa, Barfoot 2014).
class UniformStrategy {
 public:
  /// Points of a map of so many columns and rows.
  UniformStrategy(int width, int height) : width_(width), height_(height) {}

  /// One random point, pixel coordinates. Allocates nothing.
  Eigen::Vector2d draw(Random& random) const;
  /// One random point of the map at most `reach` pixels away along either axis. Allocates nothing.
  Eigen::Vector2d draw_near(const Eigen::Vector2d& centre, double reach, Random& random) const;
  /// From now on only points over which a path between two points, pixel coordinates, could be shorter than `length`.
  void inform(const Eigen::Vector2d& start, const Eigen::Vector2d& goal, double length);
  /// True for a point over which a path could be shorter than the best known one.
  bool could_improve(const Eigen::Vector2d& point) const {
    return !informed_ || (point - focus_).norm() + (point - other_focus_).norm() < length_;
  }

 private:
  Eigen::Vector2d draw_from_map(Random& random) const;
  Eigen::Vector2d draw_from_ellipse(Random& random) const;

  double width_;
  double height_;
  bool informed_ = false;
  Eigen::Vector2d focus_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d other_focus_ = Eigen::Vector2d::Zero();
  double length_ = 0.0;
  Eigen::Vector2d half_major_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d half_minor_ = Eigen::Vector2d::Zero();
};

}  // namespace lrrt
