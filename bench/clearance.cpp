// SPDX-License-Identifier: BSD-3-Clause
#include "clearance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lrrt/map/distance_field.hpp"

namespace lrrt::bench {

Clearance clearance_of(const OccupancyMap& map, const std::vector<Eigen::Vector2d>& path) {
  if (path.empty()) return {};
  const DistanceField field(map);
  double least = std::numeric_limits<double>::infinity();
  double sum = 0.0;
  double length = 0.0;
  const auto look = [&](const Eigen::Vector2d& pixel, double weight) {
    const double distance = field.at(OccupancyMap::pixel_of(pixel));
    least = std::min(least, distance);
    sum += weight * distance;
    length += weight;
  };
  look(map.to_pixel(path.front()), 0.0);
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Vector2d from = map.to_pixel(path[i - 1]);
    const Eigen::Vector2d to = map.to_pixel(path[i]);
    const double apart = (to - from).norm();
    const int steps = std::max(1, static_cast<int>(std::ceil(2.0 * apart)));
    for (int k = 1; k < steps; ++k) look(from + (to - from) * k / steps, apart / steps);
    look(to, apart / steps);  // the end itself: rounding may put it beside a wall into it
  }
  return {least * map.resolution(), (length > 0.0 ? sum / length : least) * map.resolution()};
}

}  // namespace lrrt::bench
