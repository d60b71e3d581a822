// SPDX-License-Identifier: BSD-3-Clause
#include "footprint_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace lrrt::test {
namespace {

using Eigen::Vector2d;
using Vertices = std::vector<Vector2d>;

constexpr double pi = 3.14159265358979323846;
constexpr double infinity = std::numeric_limits<double>::infinity();

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

std::pair<Vector2d, Vector2d> box(const Vertices& corners, double margin) {
  Vector2d low = corners.front();
  Vector2d high = low;
  for (const Vector2d& corner : corners) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  return {low.array() - margin, high.array() + margin};
}

std::array<Vector2d, 4> square(int c, int r) {
  return {Vector2d(c, r), Vector2d(c + 1, r), Vector2d(c + 1, r + 1), Vector2d(c, r + 1)};
}

/// Whether the projections of a triangle and a pixel overlap on an axis.
bool overlap(const std::array<Vector2d, 3>& triangle, int c, int r, const Vector2d& axis) {
  double low[2] = {infinity, infinity};
  double high[2] = {-infinity, -infinity};
  for (const Vector2d& p : triangle) {
    low[0] = std::min(low[0], axis.dot(p));
    high[0] = std::max(high[0], axis.dot(p));
  }
  for (const Vector2d& p : square(c, r)) {
    low[1] = std::min(low[1], axis.dot(p));
    high[1] = std::max(high[1], axis.dot(p));
  }
  return low[0] <= high[1] && low[1] <= high[0];
}

double to_segment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

/// Distance to a pixel that the robot does not touch.
double gap(const Vertices& corners, int c, int r) {
  const auto pixel = square(c, r);
  double least = infinity;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      least = std::min(least, to_segment(corners[i], pixel[k], pixel[(k + 1) % 4]));
      least = std::min(least, to_segment(pixel[k], corners[i], corners[(i + 1) % corners.size()]));
    }
  }
  return least;
}

}  // namespace

FootprintOracle::FootprintOracle(const OccupancyMap& map, Vertices vertices)
    : map_(map), vertices_(std::move(vertices)) {
  clip_ears();
}

bool FootprintOracle::keeps(const Pose2& pose, double distance) const {
  const Vertices corners = placed(pose);
  const auto [low, high] = box(corners, distance);
  for (int r = static_cast<int>(std::floor(low.y())); r <= high.y(); ++r) {
    for (int c = static_cast<int>(std::floor(low.x())); c <= high.x(); ++c) {
      if (map_.is_free({c, r})) continue;
      if (touches(corners, c, r) || (distance > 0.0 && gap(corners, c, r) < distance)) return false;
    }
  }
  return true;
}

Vertices FootprintOracle::placed(const Pose2& pose) const {
  Vertices corners;
  const double cosine = std::cos(pose.yaw);
  const double sine = std::sin(pose.yaw);
  for (const Vector2d& v : vertices_) {
    const Vector2d world(pose.x + cosine * v.x() - sine * v.y(), pose.y + sine * v.x() + cosine * v.y());
    corners.push_back(map_.to_pixel(world));
  }
  return corners;
}

void FootprintOracle::clip_ears() {
  std::vector<std::size_t> left(vertices_.size());
  std::iota(left.begin(), left.end(), 0U);
  double area = 0.0;
  for (std::size_t i = 0; i < left.size(); ++i) area += cross(vertices_[i], vertices_[(i + 1) % left.size()]);
  if (area < 0.0) std::reverse(left.begin(), left.end());
  while (left.size() > 3) {
    std::size_t i = 0;
    while (i < left.size() && !is_ear(left, i)) ++i;
    if (i == left.size()) throw std::logic_error("the polygon of a test is not simple: it has no ear");
    const std::size_t n = left.size();
    triangles_.push_back({left[(i + n - 1) % n], left[i], left[(i + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
  }
  triangles_.push_back({left[0], left[1], left[2]});
}

bool FootprintOracle::is_ear(const std::vector<std::size_t>& left, std::size_t i) const {
  const std::size_t n = left.size();
  const Vector2d& a = vertices_[left[(i + n - 1) % n]];
  const Vector2d& b = vertices_[left[i]];
  const Vector2d& c = vertices_[left[(i + 1) % n]];
  if (cross(b - a, c - b) <= 0.0) return false;
  for (const std::size_t k : left) {
    const Vector2d& p = vertices_[k];
    if (p == a || p == b || p == c) continue;
    if (cross(b - a, p - a) >= 0.0 && cross(c - b, p - b) >= 0.0 && cross(a - c, p - c) >= 0.0) return false;
  }
  return true;
}

bool FootprintOracle::touches(const Vertices& corners, int c, int r) const {
  for (const auto& [i, j, k] : triangles_) {
    const std::array<Vector2d, 3> triangle = {corners[i], corners[j], corners[k]};
    bool all = overlap(triangle, c, r, {1.0, 0.0}) && overlap(triangle, c, r, {0.0, 1.0});
    for (std::size_t e = 0; all && e < 3; ++e) {
      const Vector2d side = triangle[(e + 1) % 3] - triangle[e];
      all = overlap(triangle, c, r, {-side.y(), side.x()});
    }
    if (all) return true;
  }
  return false;
}

Vertices random_vertices(Random& random, double size) {
  const std::size_t n = 3 + random.index(6);
  const Vector2d centre = size * Vector2d(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5));
  Vertices vertices;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2.0 * pi * (static_cast<double>(i) + random.uniform(0.0, 0.8)) / static_cast<double>(n);
    vertices.push_back(centre + size * random.uniform(0.15, 1.0) * Vector2d(std::cos(angle), std::sin(angle)));
  }
  if (random.uniform() < 0.5) std::reverse(vertices.begin(), vertices.end());
  return vertices;
}

}  // namespace lrrt::test
