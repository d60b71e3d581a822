// SPDX-License-Identifier: BSD-3-Clause
#include "corner_field.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>

namespace lrrt::bench {
namespace {

/// The most that an eight-neighbour path over corners is longer than the shortest path: 1 / cos(π/8).
constexpr double stretch = 1.0823922002923940;
/// The origin is no corner; from the farthest corner of its pixel it is less than this away, there and back.
constexpr double origin_slack = 4.0;

struct Step {
  Pixel by;
  float length;
};
constexpr float diagonal = 1.41421356F;
constexpr std::array<Step, 8> steps = {{{{1, 0}, 1.0F},
                                        {{-1, 0}, 1.0F},
                                        {{0, 1}, 1.0F},
                                        {{0, -1}, 1.0F},
                                        {{1, 1}, diagonal},
                                        {{1, -1}, diagonal},
                                        {{-1, 1}, diagonal},
                                        {{-1, -1}, diagonal}}};

/// True when a pixel that the step runs through or along is free.
bool passable(const OccupancyMap& map, Pixel from, Pixel by) {
  const Pixel first{by.c < 0 ? from.c - 1 : from.c, by.r < 0 ? from.r - 1 : from.r};
  if (map.is_free(first)) return true;
  if (by.c == 0) return map.is_free({first.c - 1, first.r});
  return by.r == 0 && map.is_free({first.c, first.r - 1});
}

}  // namespace

CornerField::CornerField(const OccupancyMap& map, const Eigen::Vector2d& origin)
    : width_(map.width() + 1),
      origin_(origin),
      distance_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(map.height() + 1),
                std::numeric_limits<float>::infinity()) {
  using Entry = std::tuple<float, int, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto reach = [&](Pixel corner, float distance) {
    float& known = distance_[index(corner)];
    if (distance >= known) return;
    known = distance;
    open.emplace(distance, corner.c, corner.r);
  };
  const Pixel pixel = OccupancyMap::pixel_of(origin);
  for (const int r : {0, 1}) {
    for (const int c : {0, 1}) reach({pixel.c + c, pixel.r + r}, 0.0F);
  }
  while (!open.empty()) {
    const auto [distance, c, r] = open.top();
    open.pop();
    if (distance > distance_[index({c, r})]) continue;
    for (const Step& step : steps) {
      // No step leaves the map: outside no pixel is free.
      if (passable(map, {c, r}, step.by)) reach({c + step.by.c, r + step.by.r}, distance + step.length);
    }
  }
}

double CornerField::at_least(Pixel corner) const {
  const double straight = (Eigen::Vector2d(corner.c, corner.r) - origin_).norm();
  return std::max(straight, (distance_[index(corner)] - origin_slack) / stretch);
}

}  // namespace lrrt::bench
