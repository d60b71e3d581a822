// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lrrt/error.hpp"
#include "support.hpp"

namespace lrrt {
namespace {

TEST(OccupancyMap, APictureIsInPixels) {
  const OccupancyMap map = test::map_from_rows({"..#", "?.."});
  EXPECT_FALSE(map.is_metric());
  EXPECT_EQ(map.to_pixel({1.25, 0.5}), Eigen::Vector2d(1.25, 0.5));
  EXPECT_EQ(map.at({2, 0}), Cell::occupied);
  EXPECT_EQ(map.at({0, 1}), Cell::unknown);
  EXPECT_FALSE(map.is_free({0, 1}));
  EXPECT_FALSE(map.is_free({3, 0}));
  EXPECT_FALSE(map.is_free({0, -1}));
}

TEST(OccupancyMap, AMetricMapHasYUpAndItsOriginAtTheLowerLeft) {
  const OccupancyMap map(4, 2, std::vector<Cell>(8, Cell::free), 0.5, {10.0, 20.0, 0.0});
  EXPECT_TRUE(map.to_world({0.0, 2.0}).isApprox(Eigen::Vector2d(10.0, 20.0)));
  EXPECT_TRUE(map.to_world({4.0, 0.0}).isApprox(Eigen::Vector2d(12.0, 21.0)));
  EXPECT_TRUE(map.center({0, 1}).isApprox(Eigen::Vector2d(10.25, 20.25)));
}

TEST(OccupancyMap, YawTurnsTheMapAboutItsOrigin) {
  const OccupancyMap map(4, 2, std::vector<Cell>(8, Cell::free), 1.0, {0.0, 0.0, std::acos(0.0)});
  EXPECT_TRUE(map.to_world({4.0, 2.0}).isApprox(Eigen::Vector2d(0.0, 4.0)));
  const Bounds box = map.bounds();
  EXPECT_TRUE(box.low.isApprox(Eigen::Vector2d(-2.0, 0.0)));
  EXPECT_NEAR(box.high.x(), 0.0, 1e-12);
  EXPECT_NEAR(box.high.y(), 4.0, 1e-12);
}

TEST(OccupancyMap, ConversionsRoundTripInRandomFrames) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const OccupancyMap map(7, 5, std::vector<Cell>(35, Cell::free), random.uniform(0.01, 3.0),
                           {random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(-4, 4)});
    const Eigen::Vector2d pixel(random.uniform(0, 7), random.uniform(0, 5));
    EXPECT_LT((map.to_pixel(map.to_world(pixel)) - pixel).norm(), 1e-9);
    const Eigen::Vector2d world = map.to_world(pixel);
    const Bounds box = map.bounds();
    EXPECT_TRUE((world.array() >= box.low.array() - 1e-9).all() && (world.array() <= box.high.array() + 1e-9).all());
  }
}

TEST(OccupancyMap, UnknownIsResolvedAsTheCallerSays) {
  const OccupancyMap map = test::map_from_rows({"?."});
  EXPECT_EQ(map.resolved(UnknownIs::occupied).at({0, 0}), Cell::occupied);
  EXPECT_EQ(map.resolved(UnknownIs::free).at({0, 0}), Cell::free);
}

TEST(OccupancyMap, FarAndBrokenPointsAreNeverOnTheMap) {
  const OccupancyMap map = test::map_from_rows({"."});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double far : {1e300, -1e300, nan, std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(map.contains(OccupancyMap::pixel_of({far, 0.5})));
    EXPECT_FALSE(map.contains(OccupancyMap::pixel_of({0.5, far})));
  }
}

TEST(OccupancyMap, BadSizesAndFramesAreRefused) {
  EXPECT_THROW(OccupancyMap(0, 3, {}), MapError);
  EXPECT_THROW(OccupancyMap(2, 2, std::vector<Cell>(3)), MapError);
  const std::vector<Cell> one(1, Cell::free);
  EXPECT_THROW(OccupancyMap(1, 1, one, 0.0, {}), MapError);
  EXPECT_THROW(OccupancyMap(1, 1, one, -0.05, {}), MapError);
  EXPECT_THROW(OccupancyMap(1, 1, one, std::nan(""), {}), MapError);
  EXPECT_THROW(OccupancyMap(1, 1, one, 1.0, {0.0, std::nan(""), 0.0}), MapError);
}

}  // namespace
/// A random frame for a map: a plain picture, or metres with an origin and a yaw.
OccupancyMap in_random_frame(OccupancyMap map, Random& random) {
  if (random.uniform() < 0.5) return map;
  return {map.width(),
          map.height(),
          map.cells(),
          random.uniform(0.01, 3.0),
          {random.uniform(-90.0, 90.0), random.uniform(-90.0, 90.0), random.uniform(-4.0, 4.0)}};
}

TEST(OccupancyMap, APartLiesWhereItLayExactly) {
  Random random(21);
  for (int i = 0; i < 300; ++i) {
    const OccupancyMap map = in_random_frame(test::random_map(random, 2, 60), random);
    const auto below = [&](int n) { return static_cast<int>(random.index(static_cast<std::size_t>(n))); };
    const int c = below(map.width());
    const int r = below(map.height());
    const PixelBox box{c, r, 1 + below(map.width() - c), 1 + below(map.height() - r)};
    const OccupancyMap part = map.cropped(box);
    ASSERT_EQ(part.resolution(), map.resolution());
    ASSERT_EQ(part.is_metric(), map.is_metric());
    for (int k = 0; k < 50; ++k) {
      const Eigen::Vector2d point =
          map.to_world({random.uniform(-2.0, map.width() + 2.0), random.uniform(-2.0, map.height() + 2.0)});
      const Pixel whole = OccupancyMap::pixel_of(map.to_pixel(point));
      const Pixel there{whole.c - box.c, whole.r - box.r};
      ASSERT_EQ(OccupancyMap::pixel_of(part.to_pixel(point)), there);
      ASSERT_EQ(part.is_free(there), map.is_free(whole) && part.contains(there));
      ASSERT_NEAR((part.to_world(part.to_pixel(point)) - point).norm(), 0.0, 1e-9);
    }
    const OccupancyMap again(part.width(), part.height(), part.cells(), part.resolution(), part.origin());
    if (!map.is_metric()) continue;
    ASSERT_NEAR((again.to_world({0.3, 0.7}) - part.to_world({0.3, 0.7})).norm(), 0.0, 1e-9);
  }
}

TEST(OccupancyMap, WhatIsFreeInLargerPixelsIsFree) {
  Random random(22);
  for (int i = 0; i < 200; ++i) {
    const OccupancyMap map = in_random_frame(test::random_map(random, 2, 60), random);
    const int factor = 1 << random.index(4);
    const OccupancyMap coarse = map.coarsened(factor);
    ASSERT_EQ(coarse.coarseness(), factor);
    ASSERT_DOUBLE_EQ(coarse.resolution(), factor * map.resolution());
    for (int r = 0; r < coarse.height() * factor; ++r) {
      for (int c = 0; c < coarse.width() * factor; ++c) {
        const Pixel larger = OccupancyMap::pixel_of(coarse.to_pixel(map.center({c, r})));
        ASSERT_EQ(larger, (Pixel{c / factor, r / factor}));
        ASSERT_TRUE(!coarse.is_free(larger) || map.is_free({c, r}));
      }
    }
    for (int r = 0; r < map.height() / factor; ++r) {  // whole blocks alone
      for (int c = 0; c < map.width() / factor; ++c) {
        bool free = true;
        for (int k = 0; k < factor * factor; ++k) {
          free = free && map.is_free({c * factor + k % factor, r * factor + k / factor});
        }
        ASSERT_EQ(coarse.is_free({c, r}), free);
      }
    }
  }
}

TEST(OccupancyMap, LargerPixelsKnowUnknownFromOccupied) {
  const OccupancyMap coarse = test::map_from_rows({"..?.", "..?#", "....", "...."}).coarsened(2);
  EXPECT_EQ(coarse.at({0, 0}), Cell::free);
  EXPECT_EQ(coarse.at({1, 0}), Cell::occupied);
  EXPECT_EQ(test::map_from_rows({".?", ".."}).coarsened(2).at({0, 0}), Cell::unknown);
  EXPECT_EQ(test::map_from_rows({"..."}).coarsened(2).at({0, 0}), Cell::occupied);  // the block leaves the map
}

TEST(OccupancyMap, PartsAndFactorsThatAreNoneAreRefused) {
  const OccupancyMap map = test::map_from_rows({"....", "...."});
  for (const PixelBox& box : {PixelBox{0, 0, 5, 1}, PixelBox{-1, 0, 2, 1}, PixelBox{0, 0, 0, 1}, PixelBox{3, 1, 1, 2},
                              PixelBox{2147483647, 0, 2147483647, 1}}) {
    EXPECT_THROW(map.cropped(box), MapError);
  }
  for (const int factor : {0, -2, 3, 1 << 20}) EXPECT_THROW(map.coarsened(factor), MapError);
}

}  // namespace lrrt
