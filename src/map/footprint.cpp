// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/map/footprint.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "distance_transform.hpp"
#include "lrrt/error.hpp"

namespace lrrt {
namespace {

/// The open pixels whose eight neighbours are open too; outside the picture nothing is.
std::vector<std::uint8_t> shrunk(const std::vector<std::uint8_t>& open, int width, int height) {
  std::vector<std::uint8_t> result(open.size(), 0);
  const auto at = [&](int c, int r) {
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(width) + static_cast<std::size_t>(c);
  };
  for (int r = 1; r < height - 1; ++r) {
    for (int c = 1; c < width - 1; ++c) {
      bool all = true;
      for (int k = -1; k <= 1; ++k) all = all && open[at(c - 1, r + k)] && open[at(c, r + k)] && open[at(c + 1, r + k)];
      result[at(c, r)] = static_cast<std::uint8_t>(all);
    }
  }
  return result;
}

}  // namespace

OccupancyMap inflated(OccupancyMap map, double radius) {
  if (!std::isfinite(radius) || radius < 0.0) {
    throw RequestError("robot radius " + std::to_string(radius) + " must be zero or a positive number of map units");
  }
  if (radius == 0.0) return map;
  // The gap between two pixel squares is the distance between the centre of one and the centres of the 3×3 block around
  // the other, so shrinking by one pixel turns the centre-to-centre transform into the square-to-square distance.
  const int width = map.width();
  const int height = map.height();
  const std::vector<std::int32_t> squared_gap =
      squared_distances(shrunk(map.free_mask(), width, height), width, height);
  const double pixels = radius / map.resolution();
  std::vector<Cell> cells = map.cells();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool fits = static_cast<double>(squared_gap[i]) >= pixels * pixels;
    if (!fits && cells[i] == Cell::free) cells[i] = Cell::occupied;
  }
  return map.with_cells(std::move(cells));
}

}  // namespace lrrt
