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
}  // namespace lrrt
