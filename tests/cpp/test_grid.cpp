// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "lrrt/error.hpp"
#include "lrrt/map/components.hpp"
#include "lrrt/map/flood.hpp"
#include "lrrt/map/shortest_path.hpp"
#include "lrrt/region/geodesic.hpp"
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

TEST(Flood, EqualsTheIndependentFloodFill) {
  Random random(25);
  for (int i = 0; i < 80; ++i) {
    const OccupancyMap map = test::random_map(random, 1, 40);
    const Pixel from = OccupancyMap::pixel_of(test::random_free_point(map, random));
    const std::vector<std::uint8_t> expected = test::flood(map, from);
    const Flood flood(map.free_mask(), map.width(), map.height(), from);
    int left = map.width();
    int bottom = 0;
    for (int r = 0; r < map.height(); ++r) {
      for (int c = 0; c < map.width(); ++c) {
        const bool reached = expected[map.index({c, r})] != 0;
        ASSERT_EQ(flood.reached({c, r}), reached);
        if (reached) left = std::min(left, c);
        if (reached) bottom = std::max(bottom, r);
      }
    }
    EXPECT_EQ(flood.box().c, left);
    EXPECT_EQ(flood.box().r + flood.box().height - 1, bottom);
    EXPECT_FALSE(flood.reached({-1, 0}));
  }
  const OccupancyMap wall = test::map_from_rows({"#."});
  EXPECT_FALSE(Flood(wall.free_mask(), 2, 1, {0, 0}).reached({0, 0}));
  EXPECT_FALSE(Flood(wall.free_mask(), 2, 1, {5, 5}).reached({1, 0}));
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

double length(const std::vector<Eigen::Vector2d>& points) {
  double sum = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += (points[i] - points[i - 1]).norm();
  return sum;
}

TEST(ShortestPath, ClearanceKeepsAwayFromWallsWhereThereIsRoom) {
  const OccupancyMap map = test::map_from_rows(std::vector<std::string>(21, std::string(60, '.')));
  const std::vector<Pixel> straight = shortest_path(map, {1, 1}, {58, 1});
  const std::vector<Pixel> away = shortest_path(map, {1, 1}, {58, 1}, {6.0});
  const auto deepest = [](const std::vector<Pixel>& path) {
    return std::max_element(path.begin(), path.end(), [](Pixel a, Pixel b) { return a.r < b.r; })->r;
  };
  EXPECT_EQ(deepest(straight), 1);
  EXPECT_GE(deepest(away), 4);
  EXPECT_THROW(shortest_path(map, {1, 1}, {2, 1}, {-1.0}), RequestError);
  EXPECT_THROW(shortest_path(map, {1, 1}, {2, 1}, {1.0, std::nan("")}), RequestError);
}

TEST(ShortestPath, SmoothingKeepsEndsFreedomAndNeverAddsLength) {
  Random random(23);
  int shorter = 0;
  for (int i = 0; i < 60; ++i) {
    const OccupancyMap map = test::random_map(random, 2, 40);
    const Pixel start = OccupancyMap::pixel_of(test::random_free_point(map, random));
    const Pixel goal = OccupancyMap::pixel_of(test::random_free_point(map, random));
    for (const double distance : {0.0, 4.0}) {
      const ClearanceCost clearance{distance};
      const std::vector<Pixel> path = shortest_path(map, start, goal, clearance);
      if (path.empty()) continue;
      const std::vector<Eigen::Vector2d> taut = smoothed(map, path, clearance);
      EXPECT_EQ(taut.front(), Eigen::Vector2d(start.c + 0.5, start.r + 0.5));
      EXPECT_EQ(taut.back(), Eigen::Vector2d(goal.c + 0.5, goal.r + 0.5));
      for (std::size_t k = 1; k < taut.size(); ++k) ASSERT_FALSE(test::crosses_blocked(map, taut[k - 1], taut[k]));
      if (distance == 0.0) {
        EXPECT_LE(length(taut), path_length(path) + 1e-6);
        shorter += static_cast<int>(length(taut) < path_length(path) - 1e-6);
      }
    }
  }
  EXPECT_GT(shorter, 10);
}

TEST(WidenedPath, HoldsThePathStaysFreeAndNeverLeaksThroughAWall) {
  const OccupancyMap map = test::map_from_rows({"..........", "..........", "##########", "..........", ".........."});
  const std::vector<std::uint8_t> mask = widened(map, {{0.5, 1.5}, {9.5, 1.5}}, 4.0);
  for (int c = 0; c < 10; ++c) {
    EXPECT_EQ(mask[map.index({c, 0})], 1);
    EXPECT_EQ(mask[map.index({c, 1})], 1);
    for (int r = 2; r < 5; ++r) EXPECT_EQ(mask[map.index({c, r})], 0);
  }
  const std::vector<std::uint8_t> narrow = widened(map, {{0.5, 1.5}, {9.5, 1.5}}, 0.0);
  EXPECT_EQ(std::accumulate(narrow.begin(), narrow.end(), 0), 10);
  EXPECT_THROW(widened(map, {{0.5, 1.5}}, -1.0), RequestError);
  EXPECT_THROW(widened(map, {{0.5, 1.5}}, std::nan("")), RequestError);
}

/// Bellman-Ford over the eight neighbours with steps of 5 and 7: slow and simple.
std::vector<std::int32_t> brute_geodesic(const OccupancyMap& map, Pixel source) {
  std::vector<std::int32_t> distance(map.size(), Geodesic::unreached);
  distance[map.index(source)] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (int i = 0; i < static_cast<int>(map.size()) * 9; ++i) {
      const Pixel p{i / 9 % map.width(), i / 9 / map.width()};
      const Pixel q{p.c + i % 9 % 3 - 1, p.r + i % 9 / 3 - 1};
      const bool open =
          map.is_free(p) && map.is_free(q) && map.is_free({p.c, q.r}) && map.is_free({q.c, p.r}) && q != p;
      if (!open || distance[map.index(p)] == Geodesic::unreached) continue;
      const std::int32_t next = distance[map.index(p)] + (p.c != q.c && p.r != q.r ? 7 : 5);
      std::int32_t& known = distance[map.index(q)];
      if (known != Geodesic::unreached && known <= next) continue;
      known = next;
      changed = true;
    }
  }
  return distance;
}

TEST(Geodesic, EqualsBruteForceAndListsPixelsByDistance) {
  Random random(24);
  for (int i = 0; i < 40; ++i) {
    const OccupancyMap map = test::random_map(random, 1, 24);
    const Pixel source = OccupancyMap::pixel_of(test::random_free_point(map, random));
    const Geodesic geodesic(map.free_mask(), map.width(), map.height(), source);
    const std::vector<std::int32_t> expected = brute_geodesic(map, source);
    std::size_t reached = 0;
    for (int r = 0; r < map.height(); ++r) {
      for (int c = 0; c < map.width(); ++c) {
        ASSERT_EQ(geodesic.at({c, r}), expected[map.index({c, r})]);
        reached += static_cast<std::size_t>(expected[map.index({c, r})] != Geodesic::unreached);
      }
    }
    ASSERT_EQ(geodesic.reached().size(), reached);
    for (std::size_t k = 1; k < reached; ++k) {
      ASSERT_LE(geodesic.at(geodesic.reached()[k - 1]), geodesic.at(geodesic.reached()[k]));
    }
  }
  const OccupancyMap wall = test::map_from_rows({"#."});
  EXPECT_TRUE(Geodesic(wall.free_mask(), 2, 1, {0, 0}).reached().empty());
  EXPECT_EQ(Geodesic(wall.free_mask(), 2, 1, {7, 7}).at({7, 7}), Geodesic::unreached);
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
