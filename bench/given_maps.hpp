// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "lrrt/map/occupancy_map.hpp"
#include "lrrt/sampling/random.hpp"

namespace lrrt::bench {

/// The map files of a folder, by name; the picture of a map_server map is no map of its own. A file stands for itself.
/// @throws SuiteError when there is none.
std::vector<std::filesystem::path> maps_in(const std::filesystem::path& path);
/// The same with those of folders in the folder.
std::vector<std::filesystem::path> maps_below(const std::filesystem::path& path);

/// The map with so many pixels on its longer side, each the nearest one of the map: larger maps lose detail. In metres
/// it covers the same place; a plain picture stays one, and its map units become the new pixels.
OccupancyMap resized(const OccupancyMap& map, int pixels);

/// How a mosaic is laid out, pixels.
struct MosaicLayout {
  int side = 4096;    ///< of the mosaic
  int tile = 512;     ///< side of a tile
  int corridor = 16;  ///< width of the ways between tiles
};

/// Maps thrown together. Every tile shows the largest free component of one of the maps, turned by quarter turns and,
/// where it is too large, a part of it that hangs together; a corridor joins every two neighbouring tiles from free
/// pixel to free pixel. So all that is free hangs together. The result is a plain picture.
/// @param maps at least one; pixels that are not free are blocked.
/// @throws MapError when a map has no free pixel.
OccupancyMap mosaic_of(const std::vector<OccupancyMap>& maps, const MosaicLayout& layout, Random& random);

}  // namespace lrrt::bench
