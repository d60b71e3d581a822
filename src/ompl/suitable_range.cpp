// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/ompl/suitable_range.hpp"

#include <algorithm>

namespace lrrt {

double suitable_range(const CollisionMap& map) {
  double sum = 0.0;
  std::size_t free = 0;
  const ClearanceBound& bound = map.bound();  // its average says enough, also where it is that of larger pixels
  for (const float distance : bound.field().values()) {
    sum += distance;
    free += static_cast<std::size_t>(distance > 0.0F);
  }
  const double clearance = free > 0 ? bound.coarseness() * sum / static_cast<double>(free) : 0.0;
  const double side = std::max(map.map().width(), map.map().height());
  return std::max(2.0 * clearance, side * 6.0 / 256.0) * map.map().resolution();
}

}  // namespace lrrt
