// SPDX-License-Identifier: BSD-3-Clause
#include "families.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "support.hpp"

namespace lrrt::property {
namespace {

int between(Random& random, int least, int most) {
  return least + static_cast<int>(random.index(static_cast<std::size_t>(most - least + 1)));
}

Cells sheet(int width, int height, Cell cell) {
  return {width, height, std::vector<Cell>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), cell)};
}

Cells any_sheet(Random& random, Cell cell, int least = 2) {
  const int width = between(random, least, 48);
  return sheet(width, between(random, least, 48), cell);
}

Cells noise(Random& random) {
  Cells cells = any_sheet(random, Cell::free);
  const double density = random.uniform(0.0, 0.5);
  for (Cell& cell : cells.cells) cell = random.uniform() < density ? Cell::occupied : Cell::free;
  return cells;
}

Cells blocks(Random& random) {
  const OccupancyMap map = test::random_map(random, 2, 48);
  return {map.width(), map.height(), map.cells()};
}

/// Walls of a pixel between rooms, with a door in most of them.
Cells rooms(Random& random) {
  Cells cells = any_sheet(random, Cell::free, 8);
  const int side = between(random, 3, 14);
  for (int c = side; c < cells.width; c += side + 1) {
    for (int r = 0; r < cells.height; ++r) cells.at(c, r) = Cell::occupied;
  }
  for (int r = side; r < cells.height; r += side + 1) {
    for (int c = 0; c < cells.width; ++c) cells.at(c, r) = Cell::occupied;
  }
  const int door = between(random, 1, side);
  for (int c = 0; c < cells.width; c += side + 1) {
    for (int r = 0; r < cells.height; r += side + 1) {
      const int shift = between(random, 0, side - door);
      for (int k = shift; k < shift + door && random.uniform() < 0.95; ++k) {
        if (c + side < cells.width && r + k < cells.height) cells.at(c + side, r + k) = Cell::free;
        if (r + side < cells.height && c + k < cells.width) cells.at(c + k, r + side) = Cell::free;
      }
    }
  }
  return cells;
}

/// A perfect maze, drawn depth first; corridors of one to four pixels.
Cells maze(Random& random) {
  const int columns = between(random, 2, 9);
  const int rows = between(random, 2, 9);
  const int corridor = between(random, 1, 4);
  const int pitch = corridor + 1;
  Cells cells = sheet(columns * pitch + 1, rows * pitch + 1, Cell::occupied);
  const auto open = [&](int c, int r, int width, int height) {
    for (int y = r; y < r + height; ++y) {
      for (int x = c; x < c + width; ++x) cells.at(x, y) = Cell::free;
    }
  };
  open(1, 1, corridor, corridor);
  std::vector<Pixel> way{{0, 0}};
  while (!way.empty()) {
    const Pixel at = way.back();
    const std::size_t turn = random.index(4);
    bool moved = false;
    for (std::size_t k = 0; k < 4 && !moved; ++k) {
      const Pixel step = std::array<Pixel, 4>{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}}.at((k + turn) % 4);
      const Pixel to{at.c + step.c, at.r + step.r};
      if (to.c < 0 || to.r < 0 || to.c >= columns || to.r >= rows) continue;
      if (cells.at(to.c * pitch + 1, to.r * pitch + 1) == Cell::free) continue;
      open(std::min(at.c, to.c) * pitch + 1, std::min(at.r, to.r) * pitch + 1, corridor + std::abs(step.c) * pitch,
           corridor + std::abs(step.r) * pitch);
      way.push_back(to);
      moved = true;
    }
    if (!moved) way.pop_back();
  }
  return cells;
}

/// Noise that a cellular automaton has smoothed.
Cells caves(Random& random) {
  Cells cells = any_sheet(random, Cell::free, 10);
  for (Cell& cell : cells.cells) cell = random.uniform() < 0.43 ? Cell::occupied : Cell::free;
  for (int round = 0; round < 3; ++round) {
    const OccupancyMap before(cells.width, cells.height, cells.cells);
    for (int r = 0; r < cells.height; ++r) {
      for (int c = 0; c < cells.width; ++c) {
        int walls = 0;
        for (int k = 0; k < 9; ++k) walls += static_cast<int>(!before.is_free({c + k % 3 - 1, r + k / 3 - 1}));
        cells.at(c, r) = walls > 4 ? Cell::occupied : Cell::free;
      }
    }
  }
  return cells;
}

/// One corridor of a pixel that wanders through solid ground.
Cells corridor(Random& random) {
  Cells cells = any_sheet(random, Cell::occupied, 3);
  Pixel at{between(random, 0, cells.width - 1), between(random, 0, cells.height - 1)};
  for (int leg = between(random, 1, 16); leg > 0; --leg) {
    const int sign = random.uniform() < 0.5 ? 1 : -1;
    const bool across = random.uniform() < 0.5;
    for (int step = between(random, 1, 12); step > 0; --step) {
      cells.at(at.c, at.r) = Cell::free;
      at.c = std::clamp(at.c + (across ? sign : 0), 0, cells.width - 1);
      at.r = std::clamp(at.r + (across ? 0 : sign), 0, cells.height - 1);
    }
  }
  cells.at(at.c, at.r) = Cell::free;
  return cells;
}

/// Walls of pixels that meet at their corners only.
Cells stairs(Random& random) {
  Cells cells = any_sheet(random, Cell::free, 6);
  for (int wall = between(random, 1, 4); wall > 0; --wall) {
    Pixel at{between(random, 0, cells.width - 1), between(random, 0, cells.height - 1)};
    const int down = random.uniform() < 0.5 ? 1 : -1;
    for (; at.c < cells.width && at.r >= 0 && at.r < cells.height; ++at.c, at.r += down) {
      cells.at(at.c, at.r) = Cell::occupied;
    }
  }
  return cells;
}

Cells line(Random& random) {
  const int length = between(random, 1, 60);
  Cells cells = random.uniform() < 0.5 ? sheet(length, 1, Cell::free) : sheet(1, length, Cell::free);
  for (Cell& cell : cells.cells) cell = random.uniform() < 0.03 ? Cell::occupied : Cell::free;
  return cells;
}

struct Family {
  const char* name;
  Cells (*draw)(Random&);
};

const std::vector<Family>& families() {
  static const std::vector<Family> all = {
      {"noise", noise},
      {"blocks", blocks},
      {"rooms", rooms},
      {"maze", maze},
      {"caves", caves},
      {"corridor", corridor},
      {"stairs", stairs},
      {"line", line},
      {"free", [](Random& random) { return any_sheet(random, Cell::free, 1); }},
      {"occupied", [](Random& random) { return any_sheet(random, Cell::occupied, 1); }},
  };
  return all;
}

}  // namespace

const std::vector<std::string>& family_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const Family& family : families()) result.emplace_back(family.name);
    return result;
  }();
  return names;
}

Cells random_cells(std::size_t family, Random& random) {
  return families().at(family).draw(random);
}

void sprinkle_unknown(Cells& cells, double share, Random& random) {
  for (Cell& cell : cells.cells) {
    if (random.uniform() < share) cell = Cell::unknown;
  }
}

OccupancyMap framed(Cells cells, Random& random) {
  if (random.index(3) == 0) return {cells.width, cells.height, std::move(cells.cells)};
  const double resolution = std::pow(10.0, random.uniform(-3.0, 3.0));
  const double far = 1e4 * resolution;
  const double x = random.uniform(-far, far);
  const double y = random.uniform(-far, far);
  return {cells.width, cells.height, std::move(cells.cells), resolution, {x, y, random.uniform(-4.0, 4.0)}};
}

}  // namespace lrrt::property
