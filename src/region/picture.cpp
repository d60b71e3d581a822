// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/region/picture.hpp"

#include "lrrt/error.hpp"

namespace lrrt {

std::vector<std::uint8_t> rgb_picture(const OccupancyMap& map, const PromisingRegion& region, const Colours& colours) {
  if (region.width() != map.width() || region.height() != map.height()) {
    throw RequestError("the region's size differs from the map's: draw a region over the map it was predicted for");
  }
  std::vector<std::uint8_t> picture;
  picture.reserve(3 * map.size());
  for (std::size_t i = 0; i < map.size(); ++i) {
    const bool free = map.cells()[i] == Cell::free;
    const Rgb& colour = region.mask()[i] != 0 ? colours.promising : free ? colours.free : colours.obstacle;
    picture.insert(picture.end(), colour.begin(), colour.end());
  }
  return picture;
}

}  // namespace lrrt
