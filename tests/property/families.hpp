// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lrrt/map/occupancy_map.hpp"
#include "lrrt/sampling/random.hpp"

namespace lrrt::property {

/// The kinds of maps that random_cells() draws.
const std::vector<std::string>& family_names();

/// Cells of a random map of a family, free and occupied.
struct Cells {
  int width = 0;
  int height = 0;
  std::vector<Cell> cells{};

  Cell& at(int c, int r) {
    return cells[static_cast<std::size_t>(r) * static_cast<std::size_t>(width) + static_cast<std::size_t>(c)];
  }
};
Cells random_cells(std::size_t family, Random& random);

/// Makes a random share of the cells unknown.
void sprinkle_unknown(Cells& cells, double share, Random& random);

/// The cells as a map, every third one a plain picture, the others in metres with a random frame.
OccupancyMap framed(Cells cells, Random& random);

}  // namespace lrrt::property
