// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/map/distance_field.hpp"

#include <algorithm>
#include <cmath>

#include "distance_transform.hpp"

namespace lrrt {

DistanceField::DistanceField(const OccupancyMap& map)
    : width_(map.width()), height_(map.height()), distance_(map.size()) {
  const std::vector<std::int32_t> squared = squared_distances(map.free_mask(), width_, height_);
  // Single precision holds whole numbers up to 2²⁴, and its root is then the nearest one; that is enough where no pixel
  // can be farther than 4096 from the border.
  if (std::min(width_, height_) <= 8190) {
    std::transform(squared.begin(), squared.end(), distance_.begin(),
                   [](std::int32_t d) { return std::sqrt(static_cast<float>(d)); });
  } else {
    std::transform(squared.begin(), squared.end(), distance_.begin(),
                   [](std::int32_t d) { return static_cast<float>(std::sqrt(static_cast<double>(d))); });
  }
}

}  // namespace lrrt
