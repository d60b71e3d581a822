// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lrrt/error.hpp"
#include "lrrt/map/distance_field.hpp"
#include "lrrt/map/footprint.hpp"
#include "lrrt/map/segment_walk.hpp"
#include "support.hpp"

namespace lrrt {
namespace {

/// Centre-to-centre distance to the nearest pixel that is not free, by looking at all of them and at the frame around
/// the map.
double brute_distance(const OccupancyMap& map, Pixel from) {
  double best = std::numeric_limits<double>::infinity();
  for (int r = -1; r <= map.height(); ++r) {
    for (int c = -1; c <= map.width(); ++c) {
      if (!map.is_free({c, r})) best = std::min(best, std::hypot(c - from.c, r - from.r));
    }
  }
  return best;
}

TEST(DistanceField, EqualsBruteForce) {
  Random random(11);
  for (int i = 0; i < 30; ++i) {
    const OccupancyMap map = test::random_map(random, 1, 40);
    const DistanceField field(map);
    for (int r = 0; r < map.height(); ++r) {
      for (int c = 0; c < map.width(); ++c) EXPECT_NEAR(field.at({c, r}), brute_distance(map, {c, r}), 1e-4);
    }
    EXPECT_EQ(field.at({-1, 0}), 0.0F);
    EXPECT_EQ(field.at({0, map.height()}), 0.0F);
  }
}

TEST(DistanceField, IsExactOnWideMaps) {
  for (const int width : {6000, 50000}) {
    std::vector<Cell> cells(static_cast<std::size_t>(width) * 60, Cell::free);
    const OccupancyMap map = OccupancyMap(width, 60, std::move(cells));
    const DistanceField field(map);
    for (int c = 0; c < width; c += 7) {
      for (int r = 0; r < 60; r += 7) {
        ASSERT_EQ(field.at({c, r}), static_cast<float>(std::min({c + 1, width - c, r + 1, 60 - r})))
            << width << ' ' << c;
      }
    }
  }
}

TEST(DistanceField, IsExactFarFromASinglePixelOfAWideMap) {
  constexpr int width = 20000;
  std::vector<Cell> cells(static_cast<std::size_t>(width) * 101, Cell::free);
  cells[50U * width + 10000U] = Cell::occupied;
  const DistanceField field(OccupancyMap(width, 101, std::move(cells)));
  for (int dc = -45; dc <= 45; ++dc) {
    const auto edge = static_cast<float>(std::min(51, 51 - 20));
    EXPECT_FLOAT_EQ(field.at({10000 + dc, 70}), std::min(edge, std::hypot(static_cast<float>(dc), 20.0F)));
  }
}

TEST(ClearanceBound, IsNeverMoreThanTheDistanceAndTellsWhatIsFree) {
  Random random(16);
  for (int i = 0; i < 200; ++i) {
    const OccupancyMap map = test::random_map(random, 3, 200);
    const DistanceField field(map);
    const int most_side = 1 << random.index(9);
    const ClearanceBound bound(map, most_side);
    ASSERT_LE(std::max(bound.field().width(), bound.field().height()), most_side);
    for (int r = -1; r <= map.height(); ++r) {
      for (int c = -1; c <= map.width(); ++c) {
        const float at = bound.at({c, r});
        ASSERT_EQ(at > 0.0F, map.is_free({c, r}));
        ASSERT_LE(at, field.at({c, r}) + 1e-4F) << "map " << i << " pixel " << c << ", " << r;
        ASSERT_TRUE(bound.coarseness() > 1 || at == field.at({c, r}));
      }
    }
  }
}

TEST(SegmentWalk, EqualsClippingEveryPixel) {
  Random random(12);
  int free = 0;
  int blocked = 0;
  for (int i = 0; i < 300; ++i) {
    const OccupancyMap map = test::random_map(random, 3, 80);
    // 7 pixels a side are always too few for the distance field itself
    const ClearanceBound clearance(map, i % 2 == 0 ? 1024 : 7);
    const SegmentWalk walk(clearance);
    for (int k = 0; k < 200; ++k) {
      const Eigen::Vector2d from = test::random_free_point(map, random);
      const double reach = random.uniform(0.0, map.width());
      const Eigen::Vector2d to = from + Eigen::Vector2d(random.uniform(-reach, reach), random.uniform(-reach, reach));
      const bool expected = !test::crosses_blocked(map, from, to);
      ASSERT_EQ(walk.is_free(from, to), expected)
          << "map " << i << " from " << from.transpose() << " to " << to.transpose();
      ++(expected ? free : blocked);
    }
  }
  EXPECT_GT(free, 10000);
  EXPECT_GT(blocked, 10000);
}

TEST(SegmentWalk, IsTheSameInBothDirections) {
  Random random(13);
  for (int i = 0; i < 100; ++i) {
    const OccupancyMap map = test::random_map(random, 3, 60);
    const ClearanceBound clearance(map);
    const SegmentWalk walk(clearance);
    for (int k = 0; k < 100; ++k) {
      const Eigen::Vector2d a = test::random_free_point(map, random);
      const Eigen::Vector2d b = test::random_free_point(map, random);
      EXPECT_EQ(walk.is_free(a, b), walk.is_free(b, a));
    }
  }
}

TEST(SegmentWalk, DoesNotCutCorners) {
  const OccupancyMap map = test::map_from_rows({".#", ".."});
  const ClearanceBound clearance(map);
  const SegmentWalk walk(clearance);
  EXPECT_FALSE(walk.is_free({0.5, 0.5}, {1.5, 1.5}));  // through the common corner: touches the occupied pixel
  EXPECT_TRUE(walk.is_free({0.5, 0.5}, {0.5, 1.5}));
  EXPECT_TRUE(walk.is_free({0.5, 1.5}, {1.5, 1.5}));
  EXPECT_FALSE(walk.is_free({0.6, 0.5}, {1.5, 1.5}));
}

TEST(SegmentWalk, FindsEveryExactCorner) {
  // Ends on multiples of 1/16, the line exactly through the corner (8, 8), one of the two pixels beside it blocked.
  Random random(15);
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector2d half((1.0 + static_cast<double>(random.index(100))) / 16.0,
                               (1.0 + static_cast<double>(random.index(100))) / 16.0);
    std::vector<Cell> cells(256, Cell::free);
    cells[i % 2 == 0 ? 7 * 16 + 8 : 8 * 16 + 7] = Cell::occupied;
    const OccupancyMap map(16, 16, std::move(cells));
    const ClearanceBound clearance(map);
    const SegmentWalk walk(clearance);
    const Eigen::Vector2d corner(8.0, 8.0);
    ASSERT_FALSE(walk.is_free(corner - half, corner + half)) << half.transpose();
  }
}

TEST(SegmentWalk, PointsThatAreNowhereAreNotFree) {
  const OccupancyMap map = test::map_from_rows({"...", "..."});
  const ClearanceBound clearance(map);
  const SegmentWalk walk(clearance);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(walk.is_free({0.5, 0.5}, {nan, 0.5}));
  EXPECT_FALSE(walk.is_free({0.5, 0.5}, {3.0, 0.5}));
  EXPECT_FALSE(walk.is_free({-0.001, 0.5}, {1.5, 0.5}));
  EXPECT_FALSE(walk.is_free({1e300, 0.5}, {0.5, 0.5}));
  EXPECT_TRUE(walk.is_free({0.5, 0.5}, {0.5, 0.5}));
}

TEST(SegmentWalk, SegmentsAlongPixelBordersEnd) {
  const OccupancyMap map = test::map_from_rows({"......", "......", "......"});
  const ClearanceBound clearance(map);
  const SegmentWalk walk(clearance);
  EXPECT_TRUE(walk.is_free({1.0, 1.0}, {5.0, 1.0}));
  EXPECT_TRUE(walk.is_free({5.0, 1.0}, {1.0, 1.0}));
  EXPECT_TRUE(walk.is_free({0.0, 0.0}, {2.0, 2.0}));
  EXPECT_TRUE(walk.is_free({2.0, 2.0}, {0.0, 0.0}));
  EXPECT_TRUE(walk.is_free({5.0, 0.0}, {3.0, 2.0}));
}

/// The least distance between two pixel squares.
double square_gap(int dc, int dr) {
  return std::hypot(std::max(0, std::abs(dc) - 1), std::max(0, std::abs(dr) - 1));
}

TEST(Footprint, InflationEqualsBruteForce) {
  Random random(14);
  for (int i = 0; i < 20; ++i) {
    const OccupancyMap map = test::random_map(random, 2, 24);
    const double radius = random.uniform(0.1, 5.0);
    const OccupancyMap grown = inflated(map, radius);
    for (int r = 0; r < map.height(); ++r) {
      for (int c = 0; c < map.width(); ++c) {
        bool fits = map.is_free({c, r});
        for (int q = -1; q <= map.height(); ++q) {
          for (int p = -1; p <= map.width(); ++p) {
            const bool outside = !map.contains({p, q});
            if ((outside || !map.is_free({p, q})) && square_gap(p - c, q - r) < radius) fits = false;
          }
        }
        ASSERT_EQ(grown.is_free({c, r}), fits) << c << ' ' << r << " radius " << radius;
      }
    }
  }
}

TEST(Footprint, TheRadiusIsInMapUnits) {
  const OccupancyMap map(9, 9, std::vector<Cell>(81, Cell::free), 0.1, {});
  const OccupancyMap grown = inflated(map, 0.25);
  EXPECT_FALSE(grown.is_free({2, 4}));  // two pixels from the edge, 0.2 m
  EXPECT_TRUE(grown.is_free({3, 4}));
}

TEST(Footprint, ZeroChangesNothingAndNonsenseIsRefused) {
  const OccupancyMap map = test::map_from_rows({"?.#"});
  EXPECT_EQ(inflated(map, 0.0).cells(), map.cells());
  EXPECT_THROW(inflated(map, -1.0), RequestError);
  EXPECT_THROW(inflated(map, std::nan("")), RequestError);
}

}  // namespace
}  // namespace lrrt
