// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "corner_field.hpp"
#include "reference.hpp"
#include "support.hpp"

namespace lrrt::bench {
namespace {

/// Every corner of every pixel is a place to turn, every pair is checked by clipping against every pixel (Dijkstra).
double brute_force(const OccupancyMap& map, const Eigen::Vector2d& start, const Eigen::Vector2d& goal) {
  Random random(1);
  // No two alike: else a segment could pass exactly between two blocked pixels that touch, which the clipping lets
  // through.
  const auto hair = [&] { return random.uniform(0.5e-5, 1.5e-5); };
  std::vector<Eigen::Vector2d> points{start, goal};
  for (int r = 0; r <= map.height(); ++r) {
    for (int c = 0; c <= map.width(); ++c) {
      for (const Eigen::Vector2d& side :
           {Eigen::Vector2d(1, 1), Eigen::Vector2d(1, -1), Eigen::Vector2d(-1, 1), Eigen::Vector2d(-1, -1)}) {
        const Eigen::Vector2d point = Eigen::Vector2d(c, r) + Eigen::Vector2d(hair(), hair()).cwiseProduct(side);
        if (map.is_free(OccupancyMap::pixel_of(point))) points.push_back(point);
      }
    }
  }
  std::vector<double> length(points.size(), std::numeric_limits<double>::infinity());
  std::vector<bool> done(points.size(), false);
  length[0] = 0.0;
  for (std::size_t round = 0; round < points.size(); ++round) {
    std::size_t at = points.size();
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!done[i] && std::isfinite(length[i]) && (at == points.size() || length[i] < length[at])) at = i;
    }
    if (at == points.size() || at == 1) break;
    done[at] = true;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double through = length[at] + (points[i] - points[at]).norm();
      if (!done[i] && through < length[i] && !test::crosses_blocked(map, points[at], points[i])) length[i] = through;
    }
  }
  return length[1];
}

TEST(Reference, AFreeWayIsStraight) {
  const OccupancyMap map = test::map_from_rows({".....", ".....", "....."});
  EXPECT_NEAR(shortest_length(map, {0.5, 0.5}, {4.5, 2.25}), std::hypot(4.0, 1.75), 1e-9);
}

TEST(Reference, TurnsAtTheCornersOfAnObstacle) {
  const OccupancyMap map = test::map_from_rows({".....", ".###.", "....."});
  EXPECT_NEAR(shortest_length(map, {0.5, 1.5}, {4.5, 1.5}), 3.0 + 2.0 * std::hypot(0.5, 0.5), 1e-9);
}

TEST(Reference, NoPathBetweenDiagonalPixels) {
  const OccupancyMap map = test::map_from_rows({".#", "#."});
  EXPECT_TRUE(std::isinf(shortest_length(map, {0.5, 0.5}, {1.5, 1.5})));
}

TEST(Reference, IsInMapUnits) {
  const OccupancyMap map(4, 4, std::vector<Cell>(16, Cell::free), 0.5, {1.0, 2.0, 0.3});
  const Eigen::Vector2d start = map.to_world({0.5, 0.5});
  const Eigen::Vector2d goal = map.to_world({3.5, 2.5});
  EXPECT_NEAR(shortest_length(map, start, goal), (goal - start).norm(), 1e-9);
}

TEST(Reference, EqualsBruteForceOnRandomMaps) {
  Random random(91);
  int turning = 0;
  for (int i = 0; i < 150; ++i) {
    const OccupancyMap map = test::random_map(random, 3, 9);
    const Eigen::Vector2d start = test::random_free_point(map, random);
    const Eigen::Vector2d goal = test::random_free_point(map, random);
    const double expected = brute_force(map, start, goal);
    const double found = shortest_length(map, start, goal);
    if (std::isinf(expected)) {
      EXPECT_TRUE(std::isinf(found)) << i;
    } else {
      EXPECT_NEAR(found, expected, 1e-3) << i;
      turning += static_cast<int>(found > (goal - start).norm() + 1e-6);
    }
  }
  EXPECT_GT(turning, 20);
}

TEST(CornerField, NeverExceedsTheShortestPath) {
  Random random(92);
  for (int i = 0; i < 100; ++i) {
    const OccupancyMap map = test::random_map(random, 4, 30);
    const Eigen::Vector2d start = test::random_free_point(map, random);
    const Eigen::Vector2d goal = test::random_free_point(map, random);
    const Pixel pixel = OccupancyMap::pixel_of(start);
    const double length = shortest_length(map, start, goal);
    if (std::isinf(length)) continue;
    const CornerField field(map, goal);
    // From the corner of the start's pixel to the start it is no farther than its diagonal.
    EXPECT_LE(field.at_least(pixel), length + std::sqrt(2.0) + 1e-6) << i;
  }
}

}  // namespace
}  // namespace lrrt::bench
