// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "judge.hpp"
#include "support.hpp"

namespace lrrt::property {
namespace {

using Eigen::Vector2d;

/// Points that are looked at one by one, on every pixel of way.
constexpr double samples_a_pixel = 50.0;
/// Depth in a pixel, in pixels, that rounding cannot explain.
constexpr double hair = 1e-7;

bool deep_in_closed(const OccupancyMap& map, const Vector2d& point) {
  const Pixel pixel = OccupancyMap::pixel_of(point);
  if (map.is_free(pixel)) return false;
  return std::min({point.x() - pixel.c, point.y() - pixel.r, pixel.c + 1.0 - point.x(), pixel.r + 1.0 - point.y()}) >
         hair;
}

/// Whether a segment passes through the common corner of four pixels that are not all free. Asked only where points
/// lie on quarters of a pixel: there products are exact.
bool cuts_a_corner(const OccupancyMap& map, const Vector2d& from, const Vector2d& to) {
  const auto exact = [](const Vector2d& p) { return (p * 4.0).array().round().isApprox(p.array() * 4.0, 0.0); };
  if (map.size() > 1U << 20U || !exact(from) || !exact(to)) return false;
  const Vector2d way = to - from;
  const Vector2d low = from.cwiseMin(to);
  const Vector2d high = from.cwiseMax(to);
  for (int y = static_cast<int>(std::floor(low.y())) + 1; y < high.y(); ++y) {
    for (int x = static_cast<int>(std::floor(low.x())) + 1; x < high.x(); ++x) {
      if (way.x() * (y - from.y()) != way.y() * (x - from.x())) continue;
      for (int k = 0; k < 4; ++k) {
        if (!map.is_free({x - k % 2, y - k / 2})) return true;
      }
    }
  }
  return false;
}

bool passes_closed_pixels(const OccupancyMap& map, const Vector2d& from, const Vector2d& to) {
  const auto steps = static_cast<int>(std::ceil((to - from).norm() * samples_a_pixel));
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / std::max(1, steps);
    if (deep_in_closed(map, (1.0 - t) * from + t * to)) return true;
  }
  return false;
}

/// Whether a disc that moves along a segment touches an obstacle or leaves the map.
bool disc_touches(const OccupancyMap& bare, const Vector2d& from, const Vector2d& to, double radius) {
  const double edge = std::min({from.x(), from.y(), to.x(), to.y(), bare.width() - std::max(from.x(), to.x()),
                                bare.height() - std::max(from.y(), to.y())});
  if (edge < radius - hair) return true;
  const Vector2d low = from.cwiseMin(to).array() - radius;
  const Vector2d high = from.cwiseMax(to).array() + radius;
  for (int r = static_cast<int>(std::floor(low.y())); r <= high.y(); ++r) {
    for (int c = static_cast<int>(std::floor(low.x())); c <= high.x(); ++c) {
      if (!bare.is_free({c, r}) && gap(from, to, {c, r}) < radius - hair) return true;
    }
  }
  return false;
}

std::string at(std::size_t segment, const char* what) {
  std::ostringstream text;
  text << "segment " << segment << ' ' << what;
  return text.str();
}

}  // namespace

std::string judge_path(const Query& query, const PlanResult& result) {
  const Ground& ground = query.ground();
  double length = 0.0;
  for (std::size_t i = 1; i < result.path.size(); ++i) {
    length += std::hypot(result.path[i].x() - result.path[i - 1].x(), result.path[i].y() - result.path[i - 1].y());
    const Vector2d from = ground.to_pixel(result.path[i - 1]);
    const Vector2d to = ground.to_pixel(result.path[i]);
    if (test::crosses_blocked(ground.grown(), from, to)) return at(i, "enters a pixel that is not free");
    if (passes_closed_pixels(ground.grown(), from, to)) return at(i, "has a point on a pixel that is not free");
    if (cuts_a_corner(ground.grown(), from, to)) return at(i, "passes a corner of four pixels that are not all free");
    if (ground.radius() > 0.0 && disc_touches(ground.bare(), from, to, ground.radius())) {
      return at(i, "brings the disc into an obstacle");
    }
  }
  if (std::abs(length - result.cost) > 1e-9 * (1.0 + length)) return "a cost that is not the path's length";
  return {};
}

}  // namespace lrrt::property
