// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/map/distance_field.hpp"

#include <algorithm>
#include <cmath>

#include "distance_transform.hpp"

namespace lrrt {

DistanceField::DistanceField(const OccupancyMap& map)
    : width_(map.width()), height_(map.height()), distance_(map.size()) {
  const std::vector<std::int64_t> squared = squared_distances(map.free_mask(), width_, height_);
  std::transform(squared.begin(), squared.end(), distance_.begin(),
                 [](std::int64_t d) { return static_cast<float>(std::sqrt(static_cast<double>(d))); });
}

}  // namespace lrrt
