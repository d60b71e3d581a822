// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "lrrt/map/occupancy_map.hpp"

namespace lrrt {

/// Shortest path over the free pixels by A* (Hart, Nilsson, Raphael 1968): eight neighbours, and a diagonal step only
/// where both pixels beside it are free, so that no corner is cut.
/// @return pixels from start to goal, both included; empty when there is no path or an end is not free.
std::vector<Pixel> shortest_path(const OccupancyMap& map, Pixel start, Pixel goal);

/// Length of a pixel path between pixel centres, in pixels.
double path_length(const std::vector<Pixel>& path);

}  // namespace lrrt
