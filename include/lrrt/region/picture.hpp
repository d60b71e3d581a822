// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lrrt/map/occupancy_map.hpp"
#include "lrrt/region/promising_region.hpp"

namespace lrrt {

using Rgb = std::array<std::uint8_t, 3>;

/// Colours of the paper's pictures (section III): start red, goal blue, free white, obstacles black, path green.
struct Colours {
  Rgb start{255, 0, 0};
  Rgb goal{0, 0, 255};
  Rgb free{255, 255, 255};
  Rgb obstacle{0, 0, 0};
  Rgb promising{0, 255, 0};
  friend bool operator==(const Colours& a, const Colours& b) {
    return a.start == b.start && a.goal == b.goal && a.free == b.free && a.obstacle == b.obstacle &&
           a.promising == b.promising;
  }
  friend bool operator!=(const Colours& a, const Colours& b) { return !(a == b); }
};

/// The map as a picture with the promising region highlighted, as in the paper's figures.
/// @return row-major red, green, blue bytes, 3 × width × height values.
std::vector<std::uint8_t> rgb_picture(const OccupancyMap& map, const PromisingRegion& region,
                                      const Colours& colours = {});

}  // namespace lrrt
