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

/// What a unit of length costs where the nearest pixel that is not free is so many pixels away, from centre to centre:
/// 1 + weight · max(0, 1 − max(0, distance − 1) / clearance.distance)².
double unit_cost(double distance, const ClearanceCost& clearance);

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
/// Length of a path of points, in their unit.
double path_length(const std::vector<Eigen::Vector2d>& path);

/// Length of a path of points after straightening: from every corner it goes on to the last point in a row that a free
/// straight motion reaches.
/// @param is_free whether the straight motion between two points is free.
template <typename IsFree>
double straightened_length(const std::vector<Eigen::Vector2d>& points, const IsFree& is_free) {
  double length = 0.0;
  for (std::size_t from = 0; from + 1 < points.size();) {
    std::size_t to = from + 1;
    while (to + 1 < points.size() && is_free(points[from], points[to + 1])) ++to;
    length += (points[to] - points[from]).norm();
    from = to;
  }
  return length;
}

}  // namespace lrrt
