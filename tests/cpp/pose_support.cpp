// SPDX-License-Identifier: BSD-3-Clause
#include "pose_support.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lrrt::test {
namespace {

constexpr double pi = 3.141592653589793;

}  // namespace

double angle_between(double a, double b) {
  return std::abs(std::remainder(a - b, 2.0 * pi));
}

bool overlaps_blocked(const OccupancyMap& map, const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& at,
                      double heading) {
  std::vector<Eigen::Vector2d> corners;
  for (const Eigen::Vector2d& v : outline) {
    const Eigen::Vector2d turned(std::cos(heading) * v.x() - std::sin(heading) * v.y(),
                                 std::sin(heading) * v.x() + std::cos(heading) * v.y());
    corners.push_back(map.to_pixel(at + turned));
  }
  Eigen::Vector2d low = corners.front();
  Eigen::Vector2d high = corners.front();
  for (const Eigen::Vector2d& c : corners) {
    low = low.cwiseMin(c);
    high = high.cwiseMax(c);
  }
  constexpr double hair = 1e-7;
  const auto apart = [&](Pixel p, const Eigen::Vector2d& axis) {
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for (const Eigen::Vector2d& c : corners) {
      least = std::min(least, axis.dot(c));
      most = std::max(most, axis.dot(c));
    }
    const double middle = axis.dot(Eigen::Vector2d(p.c + 0.5, p.r + 0.5));
    const double half = 0.5 * axis.lpNorm<1>();
    return least > middle + half - hair || most < middle - half + hair;
  };
  for (int r = static_cast<int>(std::floor(low.y())); r <= static_cast<int>(std::floor(high.y())); ++r) {
    for (int c = static_cast<int>(std::floor(low.x())); c <= static_cast<int>(std::floor(high.x())); ++c) {
      if (map.is_free({c, r})) continue;
      bool separated = apart({c, r}, {1.0, 0.0}) || apart({c, r}, {0.0, 1.0});
      for (std::size_t i = 0; i < corners.size() && !separated; ++i) {
        const Eigen::Vector2d edge = (corners[(i + 1) % corners.size()] - corners[i]).normalized();
        separated = apart({c, r}, {-edge.y(), edge.x()});
      }
      if (!separated) return true;
    }
  }
  return false;
}

Pose2 random_pose(const OccupancyMap& map, const Polygon& robot, Random& random) {
  Pose2 pose;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector2d pixel(random.uniform(0, map.width()), random.uniform(0, map.height()));
    const Eigen::Vector2d at = map.to_world(pixel);
    pose = {at.x(), at.y(), random.uniform(-pi, pi)};
    if (!overlaps_blocked(map, robot.vertices(), at, pose.yaw)) break;
  }
  return pose;
}

OccupancyMap random_room(Random& random, bool metric) {
  std::vector<Cell> cells(std::size_t{60} * 50, Cell::free);
  const int blocks = 3 + static_cast<int>(random.index(6));
  for (int i = 0; i < blocks; ++i) {
    const int c0 = static_cast<int>(random.index(55));
    const int r0 = static_cast<int>(random.index(45));
    const int w = 2 + static_cast<int>(random.index(16));
    const int h = 2 + static_cast<int>(random.index(16));
    for (int r = r0; r < std::min(50, r0 + h); ++r) {
      for (int c = c0; c < std::min(60, c0 + w); ++c)
        cells[static_cast<std::size_t>(r) * 60 + static_cast<std::size_t>(c)] = Cell::occupied;
    }
  }
  if (!metric) return {60, 50, std::move(cells)};
  return {60, 50, std::move(cells), 0.05, {-3.0, 7.0, random.uniform(-pi, pi)}};
}

}  // namespace lrrt::test
