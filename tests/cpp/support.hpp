// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lrrt/map/occupancy_map.hpp"
#include "lrrt/sampling/random.hpp"

namespace lrrt::test {

/// A plain map from rows of text: '#' occupied, '?' unknown, everything else free.
OccupancyMap map_from_rows(const std::vector<std::string>& rows);

/// A random map: blocks of random size thrown on a free ground, from nearly empty to crowded.
OccupancyMap random_map(Random& random, int least_side, int most_side);

/// A random point on a random free pixel, pixel coordinates. The map must have one.
Eigen::Vector2d random_free_point(const OccupancyMap& map, Random& random);

/// Independent of the library's walk: clips the segment against every pixel that is not free, and against the map's
/// edge. Touching a pixel's border without entering it does not count.
bool crosses_blocked(const OccupancyMap& map, const Eigen::Vector2d& from, const Eigen::Vector2d& to);

/// Independent flood fill: the pixels that can be reached from one in steps to the four neighbours, 1 or 0 for each.
std::vector<std::uint8_t> flood(const OccupancyMap& map, Pixel from);

}  // namespace lrrt::test
