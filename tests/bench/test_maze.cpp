// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "lrrt/error.hpp"
#include "lrrt/map/components.hpp"
#include "maze.hpp"
#include "support.hpp"

namespace lrrt::bench {
namespace {

constexpr std::array<MazeAlgorithm, 3> algorithms = {MazeAlgorithm::dfs, MazeAlgorithm::prim, MazeAlgorithm::wilson};

/// Pairs of free neighbours.
int edges_of(const OccupancyMap& map) {
  int edges = 0;
  for (int r = 0; r < map.height(); ++r) {
    for (int c = 0; c < map.width(); ++c) {
      if (!map.is_free({c, r})) continue;
      edges += static_cast<int>(map.is_free({c + 1, r})) + static_cast<int>(map.is_free({c, r + 1}));
    }
  }
  return edges;
}

int free_pixels(const OccupancyMap& map) {
  return static_cast<int>(std::count(map.cells().begin(), map.cells().end(), Cell::free));
}

TEST(Maze, APerfectOneIsATree) {
  for (const MazeAlgorithm algorithm : algorithms) {
    for (const int level : {5, 9, 31}) {
      Random random(11);
      const OccupancyMap maze = perfect_maze(level, algorithm, random);
      EXPECT_EQ(Components(maze).count(), 1);
      EXPECT_EQ(edges_of(maze), free_pixels(maze) - 1);
      const int side = (level - 1) / 2;
      EXPECT_EQ(free_pixels(maze), 2 * side * side - 1);
    }
  }
}

TEST(Maze, SameSeedSameMaze) {
  for (const MazeAlgorithm algorithm : algorithms) {
    Random one(5);
    Random same(5);
    Random other(6);
    const std::vector<Cell> cells = perfect_maze(21, algorithm, one).cells();
    EXPECT_EQ(perfect_maze(21, algorithm, same).cells(), cells);
    EXPECT_NE(perfect_maze(21, algorithm, other).cells(), cells);
  }
}

TEST(Maze, BraidingOpensLoopsAndKeepsTheRest) {
  Random random(3);
  const OccupancyMap maze = perfect_maze(31, MazeAlgorithm::prim, random);
  const OccupancyMap open = braided(maze, 1.0, random);
  EXPECT_GE(edges_of(open), free_pixels(open));
  EXPECT_GT(free_pixels(open), free_pixels(maze));
  for (std::size_t i = 0; i < maze.size(); ++i) {
    EXPECT_TRUE(maze.cells()[i] != Cell::free || open.cells()[i] == Cell::free);
  }
  EXPECT_EQ(braided(maze, 0.0, random).cells(), maze.cells());
}

TEST(Maze, IsDrawnInWholeBlocks) {
  Random random(4);
  const OccupancyMap maze = perfect_maze(9, MazeAlgorithm::dfs, random);
  const OccupancyMap picture = drawn(maze, 64);
  EXPECT_EQ(free_pixels(picture), free_pixels(maze) * 7 * 7);
  for (int r = 0; r < 9; ++r) {
    for (int c = 0; c < 9; ++c) {
      EXPECT_EQ(picture.is_free(OccupancyMap::pixel_of(drawn_center(maze, {c, r}, 64))), maze.is_free({c, r}));
    }
  }
  EXPECT_THROW(drawn(maze, 8), RequestError);
}

TEST(Maze, FarthestPixelsAreTheEndsOfTheLongestWay) {
  const OccupancyMap map = test::map_from_rows({"#######", "#.....#", "###.#.#", "#...#.#", "#######"});
  const auto [start, goal] = farthest_pixels(map);
  const bool found = (start == Pixel{1, 3} && goal == Pixel{5, 3}) || (start == Pixel{5, 3} && goal == Pixel{1, 3});
  EXPECT_TRUE(found) << start.c << ' ' << start.r << ' ' << goal.c << ' ' << goal.r;
}

TEST(Maze, RefusesEvenLevels) {
  Random random(1);
  EXPECT_THROW(perfect_maze(10, MazeAlgorithm::dfs, random), RequestError);
}

}  // namespace
}  // namespace lrrt::bench
