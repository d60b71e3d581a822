// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "lrrt/map/components.hpp"
#include "lrrt/map/shortest_path.hpp"
#include "support.hpp"

namespace lrrt {
namespace {

TEST(Components, EqualAFloodFill) {
  Random random(21);
  for (int i = 0; i < 50; ++i) {
    const OccupancyMap map = test::random_map(random, 1, 40);
    const Components components(map);
    const Pixel from = OccupancyMap::pixel_of(test::random_free_point(map, random));
    const std::vector<std::uint8_t> reached = test::flood(map, from);
    int area = 0;
    for (int r = 0; r < map.height(); ++r) {
      for (int c = 0; c < map.width(); ++c) {
        ASSERT_EQ(components.joined(from, {c, r}), reached[map.index({c, r})] != 0);
        area += reached[map.index({c, r})];
      }
    }
    EXPECT_EQ(components.area(components.label(from)), area);
  }
}

TEST(Components, DiagonalNeighboursAreNotJoined) {
  const Components components(test::map_from_rows({".#", "#."}));
  EXPECT_EQ(components.count(), 2);
  EXPECT_FALSE(components.joined({0, 0}, {1, 1}));
  EXPECT_FALSE(components.joined({1, 0}, {1, 0}));
  EXPECT_EQ(components.label({5, 5}), 0);
}

TEST(Components, BoxesHoldTheirPixels) {
  const Components components(test::map_from_rows({"##.#", "#..#", "####"}));
  const PixelBox box = components.box(components.label({2, 0}));
  EXPECT_EQ(box.c, 1);
  EXPECT_EQ(box.r, 0);
  EXPECT_EQ(box.width, 2);
  EXPECT_EQ(box.height, 2);
}

/// Bellman-Ford on the eight-connected grid without corner cutting: slow and simple.
double brute_length(const OccupancyMap& map, Pixel start, Pixel goal) {
  std::vector<double> cost(map.size(), std::numeric_limits<double>::infinity());
  cost[map.index(start)] = 0.0;
  for (bool changed = true; changed;) {
    changed = false;
    for (int r = 0; r < map.height(); ++r) {
      for (int c = 0; c < map.width(); ++c) {
        for (int k = 0; k < 9; ++k) {
          const int dc = k % 3 - 1;
          const int dr = k / 3 - 1;
          const bool open = map.is_free({c, r}) && map.is_free({c + dc, r + dr}) && map.is_free({c + dc, r}) &&
                            map.is_free({c, r + dr});
          if (!open) continue;
          const double next = cost[map.index({c, r})] + std::hypot(dc, dr);
          if (next + 1e-9 < cost[map.index({c + dc, r + dr})]) {
            cost[map.index({c + dc, r + dr})] = next;
            changed = true;
          }
        }
      }
    }
  }
  return cost[map.index(goal)];
}

TEST(ShortestPath, IsFreeConnectedAndAsShortAsBruteForceSays) {
  Random random(22);
  int found = 0;
  for (int i = 0; i < 60; ++i) {
    const OccupancyMap map = test::random_map(random, 2, 24);
    const Pixel start = OccupancyMap::pixel_of(test::random_free_point(map, random));
    const Pixel goal = OccupancyMap::pixel_of(test::random_free_point(map, random));
    const std::vector<Pixel> path = shortest_path(map, start, goal);
    const double expected = brute_length(map, start, goal);
    ASSERT_EQ(path.empty(), std::isinf(expected));
    if (path.empty()) continue;
    ++found;
    EXPECT_EQ(path.front(), start);
    EXPECT_EQ(path.back(), goal);
    EXPECT_NEAR(path_length(path), expected, 1e-4);
    for (std::size_t k = 1; k < path.size(); ++k) {
      EXPECT_LE(std::max(std::abs(path[k].c - path[k - 1].c), std::abs(path[k].r - path[k - 1].r)), 1);
      EXPECT_FALSE(
          test::crosses_blocked(map, {path[k - 1].c + 0.5, path[k - 1].r + 0.5}, {path[k].c + 0.5, path[k].r + 0.5}));
    }
  }
  EXPECT_GT(found, 20);
}

TEST(ShortestPath, EndsThatAreNotFreeHaveNone) {
  const OccupancyMap map = test::map_from_rows({".#?"});
  EXPECT_TRUE(shortest_path(map, {0, 0}, {1, 0}).empty());
  EXPECT_TRUE(shortest_path(map, {2, 0}, {0, 0}).empty());
  EXPECT_TRUE(shortest_path(map, {-1, 0}, {0, 0}).empty());
  EXPECT_EQ(shortest_path(map, {0, 0}, {0, 0}).size(), 1U);
}

}  // namespace
}  // namespace lrrt
