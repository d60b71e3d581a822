// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "lrrt/map/occupancy_map.hpp"

namespace lrrt {

/// Exact Euclidean distance, in pixels, from the centre of every pixel to the centre of the nearest pixel that is not
/// free. Everything outside the map counts as not free. Computed in linear time (Meijster, Roerdink, Hesselink 2000).
class DistanceField {
 public:
  /// Computes the distances of a map.
  explicit DistanceField(const OccupancyMap& map);

  /// Columns.
  int width() const { return width_; }
  /// Rows.
  int height() const { return height_; }
  /// Distance at a pixel; 0 for a pixel that is not free or lies outside the map.
  float at(Pixel p) const {
    if (p.c < 0 || p.r < 0 || p.c >= width_ || p.r >= height_) return 0.0F;
    return distance_[static_cast<std::size_t>(p.r) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(p.c)];
  }
  /// Row-major distances, width × height values.
  const std::vector<float>& values() const { return distance_; }

 private:
  int width_;
  int height_;
  std::vector<float> distance_;
};

}  // namespace lrrt
