// SPDX-License-Identifier: BSD-3-Clause
#include "clearance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lrrt/map/distance_field.hpp"

namespace lrrt::bench {

Clearance clearance_of(const OccupancyMap& map, const std::vector<Eigen::Vector2d>& path) {
  const DistanceField field(map);
  double least = std::numeric_limits<double>::infinity();
  double sum = 0.0;
  int count = 0;
  const auto look = [&](const Eigen::Vector2d& pixel) {
    const double distance = field.at(OccupancyMap::pixel_of(pixel));
    least = std::min(least, distance);
    sum += distance;
    ++count;
  };
  look(map.to_pixel(path.front()));
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Vector2d from = map.to_pixel(path[i - 1]);
    const Eigen::Vector2d step = map.to_pixel(path[i]) - from;
    const int steps = static_cast<int>(std::ceil(2.0 * step.norm()));
    for (int k = 1; k <= steps; ++k) look(from + step * k / steps);
  }
  return {least * map.resolution(), sum / count * map.resolution()};
}

}  // namespace lrrt::bench
