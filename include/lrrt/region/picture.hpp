// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lrrt/map/occupancy_map.hpp"
#include "lrrt/region/promising_region.hpp"

namespace lrrt {

/// Red, green and blue, 0 to 255.
using Rgb = std::array<std::uint8_t, 3>;

/// Colours of the paper's pictures (section III): start red, goal blue, free white, obstacles black, path green.
struct Colours {
  Rgb start{255, 0, 0};      ///< square at the start
  Rgb goal{0, 0, 255};       ///< square at the goal
  Rgb free{255, 255, 255};   ///< free pixels
  Rgb obstacle{0, 0, 0};     ///< all other pixels
  Rgb promising{0, 255, 0};  ///< pixels of the promising region
  /// True when all colours are the same.
  friend bool operator==(const Colours& a, const Colours& b) {
    return a.start == b.start && a.goal == b.goal && a.free == b.free && a.obstacle == b.obstacle &&
           a.promising == b.promising;
  }
  /// True when a colour differs.
  friend bool operator!=(const Colours& a, const Colours& b) { return !(a == b); }
};

/// The map as a picture with the promising region highlighted, as in the paper's figures.
/// @return row-major red, green, blue bytes, 3 × width × height values.
std::vector<std::uint8_t> rgb_picture(const OccupancyMap& map, const PromisingRegion& region,
                                      const Colours& colours = {});

}  // namespace lrrt
