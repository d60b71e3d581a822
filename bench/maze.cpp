// SPDX-License-Identifier: BSD-3-Clause
#include "maze.hpp"

#include <algorithm>
#include <array>

#include "lrrt/error.hpp"

namespace lrrt::bench {
namespace {

constexpr std::array<Pixel, 4> steps = {{{0, -1}, {0, 1}, {-1, 0}, {1, 0}}};

/// Two neighbouring cells, by number.
struct Edge {
  int from;
  int to;
};

/// A square grid of cells, numbered row by row.
class CellGrid {
 public:
  explicit CellGrid(int side) : side_(side), visited_(static_cast<std::size_t>(side * side), 0) {}

  int count() const { return side_ * side_; }
  bool visited(int cell) const { return visited_[static_cast<std::size_t>(cell)] != 0; }
  void visit(int cell) { visited_[static_cast<std::size_t>(cell)] = 1; }

  std::vector<int> neighbours(int cell) const {
    std::vector<int> result;
    for (const Pixel step : steps) {
      const int c = cell % side_ + step.c;
      const int r = cell / side_ + step.r;
      if (c >= 0 && r >= 0 && c < side_ && r < side_) result.push_back(r * side_ + c);
    }
    return result;
  }

  std::vector<int> unvisited_neighbours(int cell) const {
    std::vector<int> result = neighbours(cell);
    result.erase(std::remove_if(result.begin(), result.end(), [&](int n) { return visited(n); }), result.end());
    return result;
  }

 private:
  int side_;
  std::vector<std::uint8_t> visited_;
};

int any_cell(const CellGrid& grid, Random& random) {
  return static_cast<int>(random.index(static_cast<std::size_t>(grid.count())));
}

std::vector<Edge> dfs_tree(CellGrid grid, Random& random) {
  std::vector<Edge> edges;
  std::vector<int> stack{any_cell(grid, random)};
  grid.visit(stack.back());
  while (!stack.empty()) {
    const std::vector<int> options = grid.unvisited_neighbours(stack.back());
    if (options.empty()) {
      stack.pop_back();
      continue;
    }
    const int next = options[random.index(options.size())];
    grid.visit(next);
    edges.push_back({stack.back(), next});
    stack.push_back(next);
  }
  return edges;
}

std::vector<Edge> prim_tree(CellGrid grid, Random& random) {
  std::vector<Edge> edges;
  std::vector<Edge> frontier;
  const auto grow = [&](int cell) {
    grid.visit(cell);
    for (const int n : grid.unvisited_neighbours(cell)) frontier.push_back({cell, n});
  };
  grow(any_cell(grid, random));
  while (!frontier.empty()) {
    std::swap(frontier[random.index(frontier.size())], frontier.back());
    const Edge edge = frontier.back();
    frontier.pop_back();
    if (grid.visited(edge.to)) continue;
    edges.push_back(edge);
    grow(edge.to);
  }
  return edges;
}

std::vector<Edge> wilson_tree(CellGrid grid, Random& random) {
  std::vector<Edge> edges;
  std::vector<int> successor(static_cast<std::size_t>(grid.count()), 0);
  const auto next = [&](int cell) -> int& { return successor[static_cast<std::size_t>(cell)]; };
  grid.visit(any_cell(grid, random));
  for (int first = 0; first < grid.count(); ++first) {
    for (int cell = first; !grid.visited(cell); cell = next(cell)) {
      const std::vector<int> options = grid.neighbours(cell);
      next(cell) = options[random.index(options.size())];
    }
    for (int cell = first; !grid.visited(cell); cell = next(cell)) {
      grid.visit(cell);
      edges.push_back({cell, next(cell)});
    }
  }
  return edges;
}

std::vector<Edge> spanning_tree(int side, MazeAlgorithm algorithm, Random& random) {
  switch (algorithm) {
    case MazeAlgorithm::dfs:
      return dfs_tree(CellGrid(side), random);
    case MazeAlgorithm::prim:
      return prim_tree(CellGrid(side), random);
    case MazeAlgorithm::wilson:
      break;
  }
  return wilson_tree(CellGrid(side), random);
}

std::size_t block_index(int level, int c, int r) {
  return static_cast<std::size_t>(r) * static_cast<std::size_t>(level) + static_cast<std::size_t>(c);
}

/// Pixels on the way from one pixel to every other that it reaches, breadth first. @return the last one reached.
Pixel farthest_from(const OccupancyMap& map, Pixel origin) {
  std::vector<std::uint8_t> seen(map.size(), 0);
  std::vector<Pixel> queue{origin};
  seen[map.index(origin)] = 1;
  for (std::size_t head = 0; head < queue.size(); ++head) {
    for (const Pixel step : steps) {
      const Pixel next{queue[head].c + step.c, queue[head].r + step.r};
      if (!map.is_free(next) || seen[map.index(next)] != 0) continue;
      seen[map.index(next)] = 1;
      queue.push_back(next);
    }
  }
  return queue.back();
}

}  // namespace

const std::vector<std::string>& maze_algorithm_names() {
  static const std::vector<std::string> names = {"dfs", "prim", "wilson"};
  return names;
}

OccupancyMap perfect_maze(int level, MazeAlgorithm algorithm, Random& random) {
  if (level < 5 || level % 2 == 0) {
    throw RequestError("maze level is " + std::to_string(level) + ": expected an odd number of blocks, at least 5");
  }
  const int side = (level - 1) / 2;
  std::vector<Cell> cells(static_cast<std::size_t>(level) * static_cast<std::size_t>(level), Cell::occupied);
  const auto free = [&](int c, int r) { cells[block_index(level, c, r)] = Cell::free; };
  for (int cell = 0; cell < side * side; ++cell) free(2 * (cell % side) + 1, 2 * (cell / side) + 1);
  for (const Edge& e : spanning_tree(side, algorithm, random)) {
    free(e.from % side + e.to % side + 1, e.from / side + e.to / side + 1);
  }
  return {level, level, std::move(cells)};
}

OccupancyMap braided(const OccupancyMap& maze, double share, Random& random) {
  const int level = maze.width();
  std::vector<Cell> cells = maze.cells();
  for (int r = 1; r < level; r += 2) {
    for (int c = 1; c < level; c += 2) {
      std::vector<std::size_t> walls;
      int exits = 0;
      for (const Pixel step : steps) {
        const Pixel wall{c + step.c, r + step.r};
        exits += static_cast<int>(cells[maze.index(wall)] == Cell::free);
        const bool inner = wall.c > 0 && wall.r > 0 && wall.c < level - 1 && wall.r < level - 1;
        if (inner && cells[maze.index(wall)] != Cell::free) walls.push_back(maze.index(wall));
      }
      if (exits == 1 && random.uniform() < share) cells[walls[random.index(walls.size())]] = Cell::free;
    }
  }
  return maze.with_cells(std::move(cells));
}

OccupancyMap drawn(const OccupancyMap& maze, int pixels) {
  const int block = pixels / maze.width();
  if (block < 1) {
    throw RequestError("a maze of " + std::to_string(maze.width()) + " blocks on " + std::to_string(pixels) +
                       " pixels: expected at least one pixel a block");
  }
  const int margin = (pixels - block * maze.width()) / 2;
  std::vector<Cell> cells(static_cast<std::size_t>(pixels) * static_cast<std::size_t>(pixels), Cell::occupied);
  for (int r = 0; r < block * maze.height(); ++r) {
    for (int c = 0; c < block * maze.width(); ++c) {
      cells[block_index(pixels, c + margin, r + margin)] = maze.at({c / block, r / block});
    }
  }
  return {pixels, pixels, std::move(cells)};
}

Eigen::Vector2d drawn_center(const OccupancyMap& maze, Pixel block, int pixels) {
  const int side = pixels / maze.width();
  const int margin = (pixels - side * maze.width()) / 2;
  return {margin + (block.c + 0.5) * side, margin + (block.r + 0.5) * side};
}

int largest_component(const Components& components) {
  int largest = 0;
  for (int label = 1; label <= components.count(); ++label) {
    if (largest == 0 || components.area(label) > components.area(largest)) largest = label;
  }
  if (largest == 0) throw MapError("the map has no free pixel to start from");
  return largest;
}

std::vector<Pixel> pixels_of(const Components& components, int label) {
  const PixelBox& box = components.box(label);
  std::vector<Pixel> pixels;
  for (int r = box.r; r < box.r + box.height; ++r) {
    for (int c = box.c; c < box.c + box.width; ++c) {
      if (components.label({c, r}) == label) pixels.push_back({c, r});
    }
  }
  return pixels;
}

std::pair<Pixel, Pixel> farthest_pixels(const OccupancyMap& map) {
  const Components components(map);
  const int largest = largest_component(components);
  const PixelBox& box = components.box(largest);
  Pixel origin{box.c, box.r};
  while (components.label(origin) != largest) ++origin.c;
  const Pixel start = farthest_from(map, origin);
  return {start, farthest_from(map, start)};
}

}  // namespace lrrt::bench
