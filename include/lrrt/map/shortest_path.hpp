// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lrrt/map/occupancy_map.hpp"

namespace lrrt {

/// How much a path keeps away from obstacles.
struct ClearanceCost {
  double distance = 0.0;  ///< pixels; a step nearer than this to an obstacle costs more. 0: the plain shortest path
  double weight = 3.0;    ///< a step right at an obstacle costs 1 + weight times its length, falling to 1 at `distance`
};

/// Cheapest path over the free pixels by A* (Hart, Nilsson, Raphael 1968): eight neighbours, and a diagonal step only
/// where both pixels beside it are free, so that no corner is cut.
/// @return pixels from start to goal, both included; empty when there is no path or an end is not free.
/// @throws RequestError when the clearance or its weight is negative or not finite.
std::vector<Pixel> shortest_path(const OccupancyMap& map, Pixel start, Pixel goal, const ClearanceCost& clearance = {});

/// A pixel path pulled taut: corners that a free straight line of no higher cost can replace are left out.
/// @param path neighbouring free pixels, as from shortest_path(). @param clearance the cost that the path was made for.
/// @return points in pixel coordinates, the centres of the first and the last pixel included.
std::vector<Eigen::Vector2d> smoothed(const OccupancyMap& map, const std::vector<Pixel>& path,
                                      const ClearanceCost& clearance = {});

/// The free pixels within a walking distance of a path: it is widened within free space and never leaks through a wall.
/// @param points corners of the path in pixel coordinates. @param radius pixels.
/// @return row-major, 1 where a pixel belongs to the widened path, else 0.
/// @throws RequestError when the radius is negative or not finite.
std::vector<std::uint8_t> widened(const OccupancyMap& map, const std::vector<Eigen::Vector2d>& points, double radius);

/// Length of a pixel path between pixel centres, in pixels.
double path_length(const std::vector<Pixel>& path);

}  // namespace lrrt
