// SPDX-License-Identifier: BSD-3-Clause
#include "free_pixel.hpp"

#include <sstream>

#include "lrrt/error.hpp"

namespace lrrt {

Pixel free_pixel(const OccupancyMap& map, const Eigen::Vector2d& point, const char* name) {
  const Pixel pixel = OccupancyMap::pixel_of(map.to_pixel(point));
  if (map.is_free(pixel)) return pixel;
  std::ostringstream text;
  text << name << " (" << point.x() << ", " << point.y() << ") does not lie on a free pixel of the " << map.width()
       << "×" << map.height() << " map: choose a free point, in map units";
  throw RequestError(text.str());
}

}  // namespace lrrt
