// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "lrrt/map/occupancy_map.hpp"

namespace lrrt {

/// Walking distances inside a set of pixels from one of them.
///
/// Steps go to the eight neighbours, diagonally only where both pixels beside the step belong to the set; they are
/// counted 5 and 7 (Borgefors 1986: within 2 % of 1 and √2), so that a few buckets replace a heap (Dial 1969).
class Geodesic {
 public:
  static constexpr std::int32_t unreached = -1;   ///< distance of a pixel that no way leads to
  static constexpr std::int32_t straight = 5;     ///< counted length of a step to the side
  static constexpr std::int32_t diagonal = 7;     ///< counted length of a step to a corner
  static constexpr double unit = 1.0 / straight;  ///< pixels per counted length

  /// Nothing is reached.
  Geodesic() = default;
  /// @param mask row-major, not 0 where a pixel belongs to the set; width × height values.
  Geodesic(const std::vector<std::uint8_t>& mask, int width, int height, Pixel source);

  /// Distance of a pixel in fifths of a pixel; unreached where no way leads, and outside the picture.
  std::int32_t at(Pixel p) const {
    if (p.c < 0 || p.r < 0 || p.c >= width_ || p.r >= height_) return unreached;
    const std::int32_t distance = distance_[place(p)];
    return distance == waiting ? unreached : distance;
  }
  /// The next pixel on a shortest way to the source; the pixel itself at the source and where no way leads.
  Pixel step_towards_source(Pixel from) const;
  /// The pixels that were reached, nearest first.
  const std::vector<Pixel>& reached() const { return reached_; }

 private:
  static constexpr std::int32_t waiting = std::numeric_limits<std::int32_t>::max();  ///< in the set, not reached

  /// Where a pixel's distance stands: there is a border around the picture, so that a neighbour is always there to ask.
  std::size_t place(Pixel p) const {
    return (static_cast<std::size_t>(p.r) + 1) * (static_cast<std::size_t>(width_) + 2) +
           static_cast<std::size_t>(p.c) + 1;
  }
  void spread(Pixel source);

  int width_ = 0;
  int height_ = 0;
  std::vector<std::int32_t> distance_;
  std::vector<Pixel> reached_;
};

}  // namespace lrrt
