// SPDX-License-Identifier: BSD-3-Clause
#include "scenes.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "lrrt/sampling/random.hpp"
#include "made_regions.hpp"
#include "maze.hpp"

namespace lrrt::micro {
namespace {

constexpr int blocks = 35;
constexpr double covered = 1.0 / 6.0;
constexpr int smallest = 4;
constexpr int largest = 16;

/// What was made for a key before, or is made now. One store for each kind of `make`.
template <typename Key, typename Make>
const auto& kept(const Key& key, const Make& make) {
  static std::map<Key, decltype(make())> store;
  auto found = store.find(key);
  if (found == store.end()) found = store.emplace(key, make()).first;
  return found->second;
}

Scene make_maze(int side) {
  Random random(1);
  const OccupancyMap plan = bench::perfect_maze(blocks, bench::MazeAlgorithm::wilson, random);
  const auto [start, goal] = bench::farthest_pixels(plan);
  return {bench::drawn(plan, side), OccupancyMap::pixel_of(bench::drawn_center(plan, start, side)),
          OccupancyMap::pixel_of(bench::drawn_center(plan, goal, side))};
}

/// One square of the clutter, anywhere but at the rim. @return how many pixels it has.
int draw_square(std::vector<Cell>& cells, int side, Random& random) {
  const int size = smallest + static_cast<int>(random.index(largest - smallest + 1));
  const auto free_places = static_cast<std::size_t>(side - size - 1);
  const int c = 1 + static_cast<int>(random.index(free_places));
  const int r = 1 + static_cast<int>(random.index(free_places));
  for (int row = r; row < r + size; ++row) {
    const auto first = cells.begin() + static_cast<std::ptrdiff_t>(row) * side + c;
    std::fill(first, first + size, Cell::occupied);
  }
  return size * size;
}

Scene make_clutter(int side) {
  Random random(1);
  const auto pixels = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  std::vector<Cell> cells(pixels, Cell::free);
  for (double drawn = 0.0; drawn < covered * static_cast<double>(pixels);) drawn += draw_square(cells, side, random);
  return {{side, side, std::move(cells)}, {0, 0}, {side - 1, side - 1}};
}

Scene make_open_space(int side) {
  const auto pixels = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  return {{side, side, std::vector<Cell>(pixels, Cell::free)}, {0, 0}, {side - 1, side - 1}};
}

std::vector<float> plane_of(const Scene& scene, const std::string& kind) {
  const auto predictor = bench::made_region(kind);
  return predictor->predict(scene.map, scene.map.center(scene.start), scene.map.center(scene.goal))
      .region.probability();
}

}  // namespace

const Scene& maze(int side) {
  return kept(side, [&] { return make_maze(side); });
}

const Scene& clutter(int side) {
  return kept(side, [&] { return make_clutter(side); });
}

const Scene& open_space(int side) {
  return kept(side, [&] { return make_open_space(side); });
}

const std::vector<float>& perfect(const Scene& scene) {
  return kept(&scene, [&] { return plane_of(scene, "astar"); });
}

const std::vector<float>& broken(const Scene& scene) {
  return kept(&scene, [&] { return plane_of(scene, "broken"); });
}

PromisingRegion region_of(const Scene& scene, std::vector<float> probability) {
  return {scene.map, std::move(probability), scene.start, scene.goal};
}

}  // namespace lrrt::micro
