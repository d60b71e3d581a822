// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "lrrt/map/components.hpp"
#include "lrrt/map/occupancy_map.hpp"

namespace lrrt {

/// The pixels of a set that one of them reaches in steps to the four neighbours: one component of Components, found
/// without labelling all the others.
class Flood {
 public:
  /// @param mask row-major, not 0 where a pixel belongs to the set; width × height values.
  /// @param from where the flood begins; outside the set it reaches nothing.
  Flood(const std::vector<std::uint8_t>& mask, int width, int height, Pixel from);

  /// True for a pixel that was reached; not after take().
  bool reached(Pixel p) const {
    if (p.c < 0 || p.r < 0 || p.c >= width_ || p.r >= height_) return false;
    return reached_[static_cast<std::size_t>(p.r) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(p.c)] !=
           0;
  }
  /// Row-major, 1 where a pixel was reached; the flood is empty afterwards.
  std::vector<std::uint8_t> take() { return std::move(reached_); }
  /// Smallest box that holds what was reached.
  const PixelBox& box() const { return box_; }

 private:
  int width_;
  int height_;
  std::vector<std::uint8_t> reached_;
  PixelBox box_{};
};

}  // namespace lrrt
