// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lrrt/map/occupancy_map.hpp"

namespace lrrt::bench {

/// Lower bounds of the length of a free path from one point to every corner of every pixel.
///
/// Distances over the corners of the pixels, eight neighbours: straight steps along an edge of a free pixel, diagonal
/// ones across a free pixel. Such a path is at most 1.0824 times as long as the shortest one (Bailey et al. 2015, "Path
/// planning on grids: the effect of vertex placement on path length").
class CornerField {
 public:
  /// @param origin pixel coordinates, on a free pixel.
  CornerField(const OccupancyMap& map, const Eigen::Vector2d& origin);

  /// Pixels; infinite where no path leads. @param corner column and row of a pixel whose upper left corner is meant.
  double at_least(Pixel corner) const;

 private:
  std::size_t index(Pixel corner) const {
    return static_cast<std::size_t>(corner.r) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(corner.c);
  }

  int width_;  ///< corners a row
  Eigen::Vector2d origin_;
  std::vector<float> distance_;
};

}  // namespace lrrt::bench
