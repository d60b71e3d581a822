// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "lrrt/map/occupancy_map.hpp"

namespace lrrt {

/// Steps to the four neighbours of a pixel.
inline constexpr std::array<Pixel, 4> sides = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

/// The way from goal back to start of a search that noted for every pixel the number of the side it arrived by.
inline std::vector<Pixel> way_back(const OccupancyMap& map, const std::vector<std::uint8_t>& arrived_by, Pixel start,
                                   Pixel goal) {
  std::vector<Pixel> way{goal};
  while (way.back() != start) {
    const Pixel side = sides[arrived_by[map.index(way.back())]];
    way.push_back({way.back().c - side.c, way.back().r - side.r});
  }
  return way;
}

/// The pixels of a way that a mask lacks.
inline std::vector<Pixel> gap_of(const OccupancyMap& map, const std::vector<Pixel>& way,
                                 const std::vector<std::uint8_t>& mask) {
  std::vector<Pixel> gap;
  std::copy_if(way.begin(), way.end(), std::back_inserter(gap), [&](Pixel p) { return mask[map.index(p)] == 0; });
  return gap;
}

/// Takes the free pixels within a halo of a gap into a mask.
/// @param joins whether a pixel may join, given the pixel of the gap beside which it lies.
/// @return how many pixels joined.
template <typename Joins>
std::size_t close_gap(const OccupancyMap& map, const std::vector<Pixel>& gap, int halo, std::vector<std::uint8_t>& mask,
                      const Joins& joins) {
  halo = std::min(halo, std::max(map.width(), map.height()));
  std::size_t joined = 0;
  for (const Pixel p : gap) {
    for (int r = std::max(0, p.r - halo); r <= std::min(map.height() - 1, p.r + halo); ++r) {
      for (int c = std::max(0, p.c - halo); c <= std::min(map.width() - 1, p.c + halo); ++c) {
        std::uint8_t& pixel = mask[map.index({c, r})];
        if (pixel != 0 || !map.is_free({c, r}) || !joins(p, Pixel{c, r})) continue;
        pixel = 1;
        ++joined;
      }
    }
  }
  return joined;
}

}  // namespace lrrt
