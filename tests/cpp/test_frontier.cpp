// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "lrrt/error.hpp"
#include "lrrt/map/shortest_path.hpp"
#include "lrrt/ompl/map_validity.hpp"
#include "lrrt/sampling/frontier.hpp"
#include "lrrt/sampling/mixed_sampler.hpp"
#include "support.hpp"

namespace lrrt {
namespace {

/// A corridor of 100 by 4 pixels with a dead end of 30 pixels that leaves it in the middle.
const std::vector<std::string>& corridor_rows() {
  static const std::vector<std::string> rows = [] {
    std::vector<std::string> made(40, std::string(100, '#'));
    for (int r = 0; r < 4; ++r) made[static_cast<std::size_t>(r)] = std::string(100, '.');
    for (int r = 4; r < 34; ++r) made[static_cast<std::size_t>(r)].replace(48, 4, "....");
    return made;
  }();
  return rows;
}

std::shared_ptr<const OccupancyMap> corridor() {
  return std::make_shared<const OccupancyMap>(test::map_from_rows(corridor_rows()));
}

constexpr Pixel start{0, 1};
constexpr Pixel goal{99, 1};

PromisingRegion whole_of(const OccupancyMap& map) {
  return {map, std::vector<float>(map.size(), 1.0F), start, goal};
}

TEST(Frontier, DrawsJustAheadOfTheTreeInTheRegion) {
  const auto map = corridor();
  const PromisingRegion region = whole_of(*map);
  FrontierStrategy frontier(map, region, start, goal, {3.0});
  EXPECT_NEAR(frontier.remaining(0), 99.0, 1e-9);
  Random random(1);
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector2d point = frontier.draw(random);
    ASSERT_TRUE(map->is_free(OccupancyMap::pixel_of(point)));
    ASSERT_LE(point.x(), 2.0 * 3.0 * std::exp2(i / 64.0 + 0.1) + 3.0);
  }
  frontier.connected({0.5, 1.5}, {30.5, 1.5});
  EXPECT_NEAR(frontier.remaining(0), 69.0, 1e-9);
  for (int i = 0; i < 5; ++i) {
    const double x = frontier.draw(random).x();
    EXPECT_GT(x, 24.0);
    EXPECT_LT(x, 40.0);
  }
}

TEST(Frontier, StepsMayBeLongerThanAnyMap) {
  const auto map = corridor();
  Random random(2);
  for (const double step : {1e9, 1e300, std::numeric_limits<double>::max()}) {
    FrontierStrategy frontier(map, whole_of(*map), start, goal, {step});
    for (int i = 0; i < 100; ++i) ASSERT_TRUE(map->is_free(OccupancyMap::pixel_of(frontier.draw(random))));
    frontier.connected({0.5, 1.5}, {30.5, 1.5});
    for (int i = 0; i < 100; ++i) ASSERT_TRUE(map->is_free(OccupancyMap::pixel_of(frontier.draw(random))));
  }
}

TEST(Frontier, DeadEndsOfTheRegionAreLeftOut) {
  const auto map = corridor();
  FrontierStrategy frontier(map, whole_of(*map), start, goal, {3.0});
  frontier.connected({0.5, 1.5}, {49.5, 1.5});
  const double before = frontier.remaining(0);
  frontier.connected({49.5, 1.5}, {49.5, 30.5});  // into the dead end: no progress
  EXPECT_EQ(frontier.remaining(0), before);
  Random random(2);
  for (int i = 0; i < 2000; ++i) ASSERT_LT(frontier.draw(random).y(), 16.0);
  EXPECT_TRUE(frontier.contains({49.5, 30.5}));
  EXPECT_FALSE(frontier.contains({10.5, 30.5}));
  EXPECT_FALSE(frontier.contains({-1.0, 0.0}));
}

TEST(Frontier, OnlyMotionsOfTheTreeCount) {
  const auto map = corridor();
  FrontierStrategy frontier(map, whole_of(*map), start, goal, {3.0});
  frontier.connected({40.5, 1.5}, {60.5, 1.5});  // between two samples of a roadmap
  EXPECT_NEAR(frontier.remaining(0), 99.0, 1e-9);
  frontier.connected({0.5, 1.5}, {40.5, 2.5});
  frontier.connected({60.5, 1.5}, {40.5, 2.5});  // checked backwards
  EXPECT_LT(frontier.remaining(0), 45.0);
  frontier.connected({-5.0, 1.5}, {300.0, 1.5});  // outside the map
}

TEST(Frontier, ATreeFromTheGoalHasAHorizonOfItsOwn) {
  const auto map = corridor();
  FrontierStrategy frontier(map, whole_of(*map), start, goal, {3.0, Growth::two_trees});
  frontier.connected({80.5, 1.5}, {99.5, 1.5});
  EXPECT_NEAR(frontier.remaining(1), 80.0, 1e-9);
  EXPECT_NEAR(frontier.remaining(0), 99.0, 1e-9);
  Random random(3);
  int left = 0;
  for (int i = 0; i < 40; ++i) left += static_cast<int>(frontier.draw(random).x() < 50.0);
  EXPECT_EQ(left, 20);  // in turn
}

TEST(Frontier, AStalledFrontWidensAndLosesConfidenceUntilThereIsProgress) {
  const auto map = corridor();
  FrontierStrategy frontier(map, whole_of(*map), start, goal, {3.0});
  Random random(4);
  EXPECT_DOUBLE_EQ(frontier.confidence(), 1.0);
  double farthest = 0.0;
  for (int i = 0; i < 4000; ++i) farthest = std::max(farthest, frontier.draw(random).x());
  EXPECT_GT(farthest, 98.0);
  EXPECT_LE(frontier.confidence(), 0.1 + 1e-12);
  frontier.connected({0.5, 1.5}, {5.5, 1.5});
  EXPECT_DOUBLE_EQ(frontier.confidence(), 1.0);
  EXPECT_LT(frontier.draw(random).x(), 15.0);
}

TEST(Frontier, AfterAPathDrawsAreAboutShorteningIt) {
  const auto map = corridor();
  auto owned = std::make_unique<FrontierStrategy>(map, whole_of(*map), start, goal, FrontierOptions{3.0});
  MixedSampler sampler(std::move(owned), UniformStrategy(100, 40), 0.5, 5);
  const std::vector<Eigen::Vector2d> path = {{0.5, 1.5}, {50.5, 3.5}, {99.5, 1.5}};
  sampler.improved(path, 99.2);
  int uniform_far = 0;
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector2d point = sampler.draw();
    uniform_far += static_cast<int>((point - path.front()).norm() + (point - path.back()).norm() > 99.2 + 12.0);
  }
  EXPECT_EQ(uniform_far, 0);
}

TEST(Frontier, BatchesComeFromTheWholeRegionWithoutItsDeadEnds) {
  const auto map = corridor();
  FrontierStrategy frontier(map, whole_of(*map), start, goal, {3.0, Growth::batch});
  Random random(6);
  int right = 0;
  constexpr int draws = 4000;
  for (int i = 0; i < draws; ++i) {
    const Eigen::Vector2d point = frontier.draw(random);
    right += static_cast<int>(point.x() > 50.0);
    ASSERT_LT(point.y(), 16.0);
  }
  EXPECT_NEAR(right, draws / 2, 200);
}

TEST(Frontier, ARegionThatDoesNotJoinStartAndGoalIsRefused) {
  const auto map = std::make_shared<const OccupancyMap>(test::map_from_rows({"..#.."}));
  const PromisingRegion region(*map, std::vector<float>(5, 1.0F), {0, 0}, {4, 0});
  EXPECT_THROW(FrontierStrategy(map, region, {0, 0}, {4, 0}, {3.0}), RequestError);
  EXPECT_THROW(FrontierStrategy(map, region, {0, 0}, {1, 0}, {0.0}), RequestError);
}

/// Two ways round a wall of 60 rows: above it 10 pixels wide, below it 10 pixels wide and a little longer.
std::shared_ptr<const OccupancyMap> two_ways() {
  std::vector<std::string> rows(80, std::string(100, '.'));
  for (int r = 10; r < 68; ++r) rows[static_cast<std::size_t>(r)].replace(40, 20, std::string(20, '#'));
  return std::make_shared<const OccupancyMap>(test::map_from_rows(rows));
}

TEST(Frontier, AfterAPathTheOtherWayRoundIsLookedForToo) {
  const auto map = two_ways();
  std::vector<float> below(map->size(), 1.0F);
  std::fill_n(below.begin(), 100 * 30, 0.0F);
  const PromisingRegion region(*map, below, {5, 39}, {95, 39});
  FrontierStrategy frontier(map, region, {5, 39}, {95, 39}, {3.0});
  frontier.improved({{5.5, 39.5}, {39.5, 69.5}, {60.5, 69.5}, {95.5, 39.5}}, 113.0);
  Random random(9);
  int above = 0;
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector2d point = frontier.draw(random);
    above += static_cast<int>(i >= 2000 && point.y() < 12.0);
  }
  EXPECT_GT(above, 60);
  EXPECT_DOUBLE_EQ(frontier.confidence(), 1.0);
}

TEST(ShortWays, HoldsEveryPixelOfEveryShorterPath) {
  Random random(11);
  int tried = 0;
  for (int k = 0; k < 400; ++k) {
    const OccupancyMap map = test::random_map(random, 5, 30);
    const auto pixel = [&] { return OccupancyMap::pixel_of(test::random_free_point(map, random)); };
    const Pixel from = pixel();
    const Pixel to = pixel();
    const std::vector<Pixel> there = shortest_path(map, from, to);
    if (there.empty()) {
      EXPECT_FALSE(ShortWays::between(map, from, to, 10.0));
      continue;
    }
    const Pixel over = pixel();
    if (shortest_path(map, from, over).empty()) continue;
    const CollisionMap walls(map);
    const auto straight = [&](Pixel a, Pixel b) {
      std::vector<Eigen::Vector2d> points;
      for (const Pixel p : shortest_path(map, a, b)) points.push_back(map.center(p));
      return straightened_length(points, [&](const auto& p, const auto& q) { return walls.is_free(p, q); });
    };
    ShortWays ways = *ShortWays::between(map, from, to, std::numeric_limits<double>::infinity());
    const std::size_t all = ways.size();
    ways.limit(straight(from, over) + straight(over, to));
    EXPECT_LE(ways.size(), all);
    bool found = false;
    for (std::size_t i = 0; i < 40 * ways.size() && !found; ++i)
      found = OccupancyMap::pixel_of(ways.draw(random)) == over;
    EXPECT_TRUE(found) << "map " << k;
    ++tried;
  }
  EXPECT_GT(tried, 100);
}

TEST(Uniform, InformedDrawsFillTheEllipseAndNothingElse) {
  UniformStrategy uniform(100, 100);
  uniform.inform({30.0, 50.0}, {70.0, 50.0}, 50.0);
  Random random(7);
  int upper = 0;
  int inner = 0;
  constexpr int draws = 20000;
  for (int i = 0; i < draws; ++i) {
    const Eigen::Vector2d p = uniform.draw(random);
    ASSERT_LE((p - Eigen::Vector2d(30, 50)).norm() + (p - Eigen::Vector2d(70, 50)).norm(), 50.0 + 1e-9);
    upper += static_cast<int>(p.y() > 50.0);
    const Eigen::Vector2d scaled((p.x() - 50.0) / 25.0, (p.y() - 50.0) / 15.0);
    inner += static_cast<int>(scaled.norm() < std::sqrt(0.5));
  }
  EXPECT_NEAR(upper, draws / 2, 400);
  EXPECT_NEAR(inner, draws / 2, 400);
}

TEST(Uniform, InformedDrawsStayOnTheMap) {
  UniformStrategy uniform(50, 50);
  uniform.inform({1.0, 1.0}, {49.0, 1.0}, 200.0);  // the ellipse is larger than the map
  Random random(8);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector2d p = uniform.draw(random);
    ASSERT_TRUE(p.x() >= 0.0 && p.y() >= 0.0 && p.x() < 50.0 && p.y() < 50.0);
  }
}

}  // namespace
}  // namespace lrrt
