// SPDX-License-Identifier: BSD-3-Clause
#include "map_changes.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "lrrt/error.hpp"

namespace lrrt {
namespace {

/// Side, pixels, of the squares of which each that holds a change becomes a box.
constexpr int tile = 16;
/// Pixels coincide when their corners lie no farther apart, pixels: frames that are written as text differ by so
/// little.
constexpr double most_off = 1e-3;

std::string size_text(const OccupancyMap& map) {
  return std::to_string(map.width()) + "×" + std::to_string(map.height());
}

/// The pixel of a map on which the first pixel of a part lies.
Pixel corner_of(const OccupancyMap& map, const OccupancyMap& part) {
  const auto width = static_cast<double>(part.width());
  const auto height = static_cast<double>(part.height());
  const Eigen::Vector2d corner = map.to_pixel(part.to_world({0.0, 0.0}));
  const Eigen::Vector2d whole(std::round(corner.x()), std::round(corner.y()));
  const Eigen::Vector2d end = map.to_pixel(part.to_world({width, height}));
  if ((corner - whole).norm() > most_off || (end - whole - Eigen::Vector2d(width, height)).norm() > most_off) {
    std::ostringstream text;
    text << "the part of " << size_text(part) << " pixels does not lie on the map's grid: its corner is at column "
         << corner.x() << ", row " << corner.y() << " of the map, its end at column " << end.x() << ", row " << end.y()
         << "; expected whole numbers and the same resolution and yaw";
    throw MapError(text.str());
  }
  const bool inside =
      whole.x() >= 0.0 && whole.y() >= 0.0 && whole.x() + width <= map.width() && whole.y() + height <= map.height();
  if (!inside) {
    std::ostringstream text;
    text << "the part of " << size_text(part) << " pixels at column " << whole.x() << ", row " << whole.y()
         << " leaves the map of " << size_text(map) << " pixels: crop it first";
    throw MapError(text.str());
  }
  return {static_cast<int>(whole.x()), static_cast<int>(whole.y())};
}

}  // namespace

MapChanges changes_between(const OccupancyMap& map, const OccupancyMap& part) {
  const Pixel corner = corner_of(map, part);
  std::vector<Cell> cells = map.cells();
  std::vector<PixelBox> boxes;
  for (int r0 = 0; r0 < part.height(); r0 += tile) {
    for (int c0 = 0; c0 < part.width(); c0 += tile) {
      const int width = std::min(tile, part.width() - c0);
      const int height = std::min(tile, part.height() - r0);
      bool changed = false;
      for (int r = r0; r < r0 + height; ++r) {
        const Cell* source = part.cells().data() + part.index({c0, r});
        Cell* target = cells.data() + map.index({corner.c + c0, corner.r + r});
        changed = changed || !std::equal(source, source + width, target);
        std::copy(source, source + width, target);
      }
      if (changed) boxes.push_back({corner.c + c0, corner.r + r0, width, height});
    }
  }
  return {map.with_cells(std::move(cells)), std::move(boxes)};
}

}  // namespace lrrt
