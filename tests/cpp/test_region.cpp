// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lrrt/error.hpp"
#include "lrrt/region/picture.hpp"
#include "lrrt/region/promising_region.hpp"
#include "support.hpp"

namespace lrrt {
namespace {

TEST(PromisingRegion, TheMaskIsFreeAndProbable) {
  const OccupancyMap map = test::map_from_rows({".#?."});
  const PromisingRegion region(map, {0.5F, 0.9F, 0.9F, 0.49F}, {0, 0}, {3, 0});
  EXPECT_EQ(region.mask(), (std::vector<std::uint8_t>{1, 0, 0, 0}));
  EXPECT_EQ(region.area(), 1U);
  EXPECT_FALSE(region.connected());
}

TEST(PromisingRegion, ConnectedMeansJoinedInsideTheMask) {
  Random random(41);
  int joined = 0;
  for (int i = 0; i < 100; ++i) {
    const OccupancyMap map = test::random_map(random, 3, 12);
    const Pixel start = OccupancyMap::pixel_of(test::random_free_point(map, random));
    const Pixel goal = OccupancyMap::pixel_of(test::random_free_point(map, random));
    std::vector<float> probability(map.size());
    std::vector<Cell> cells = map.cells();
    for (std::size_t k = 0; k < cells.size(); ++k) {
      probability[k] = static_cast<float>(random.uniform(0.2, 1.2));
      if (probability[k] < 0.5F) cells[k] = Cell::occupied;
    }
    const bool expected = test::flood(map.with_cells(cells), start)[map.index(goal)] != 0;
    EXPECT_EQ(PromisingRegion(map, probability, start, goal).connected(), expected);
    joined += static_cast<int>(expected);
  }
  EXPECT_GT(joined, 5);
}

TEST(PromisingRegion, BrokenProbabilitiesNeverEnterTheMask) {
  const OccupancyMap map = test::map_from_rows({".."});
  const PromisingRegion region(map, {std::nanf(""), 1.0F}, {0, 0}, {1, 0});
  EXPECT_EQ(region.mask(), (std::vector<std::uint8_t>{0, 1}));
}

TEST(PromisingRegion, BridgesJoinStartAndGoalThroughTheFewestPixels) {
  Random random(42);
  int bridged = 0;
  for (int i = 0; i < 200; ++i) {
    const OccupancyMap map = test::random_map(random, 3, 40);
    const Pixel start = OccupancyMap::pixel_of(test::random_free_point(map, random));
    const Pixel goal = OccupancyMap::pixel_of(test::random_free_point(map, random));
    std::vector<float> probability(map.size());
    for (float& p : probability) p = random.uniform() < 0.7 ? 1.0F : 0.0F;
    const PromisingRegion broken(map, probability, start, goal);
    const PromisingRegion whole = broken.bridged(map, start, goal, 1);
    const bool possible = test::flood(map, start)[map.index(goal)] != 0;
    EXPECT_EQ(whole.connected(), possible);
    EXPECT_EQ(whole.area(), broken.area() + whole.bridge_area());
    std::vector<Cell> inside = map.cells();
    for (std::size_t k = 0; k < inside.size(); ++k) {
      EXPECT_GE(whole.mask()[k], broken.mask()[k]);
      EXPECT_TRUE(whole.mask()[k] == 0 || inside[k] == Cell::free);
      if (whole.mask()[k] == 0) inside[k] = Cell::occupied;
    }
    EXPECT_EQ(test::flood(map.with_cells(inside), start)[map.index(goal)] != 0, possible);
    bridged += static_cast<int>(possible && !broken.connected());
  }
  EXPECT_GT(bridged, 20);
}

TEST(PromisingRegion, ABridgeNeedsItsOwnMap) {
  const OccupancyMap map = test::map_from_rows({"..."});
  const PromisingRegion region(map, {1, 0, 1}, {0, 0}, {2, 0});
  EXPECT_THROW(region.bridged(test::map_from_rows({"...", "..."}), {0, 0}, {2, 0}), RequestError);
  EXPECT_THROW(region.bridged(map, {0, 0}, {2, 0}, -1), RequestError);
  EXPECT_TRUE(region.bridged(map, {0, 0}, {2, 0}, std::numeric_limits<int>::max()).connected());
}

TEST(PromisingRegion, ABridgeTakesTheShortestGap) {
  const OccupancyMap map = test::map_from_rows({".......", "#####.#", "......."});
  const PromisingRegion region(map, {1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 0, 1, 1}, {0, 0}, {0, 2});
  const PromisingRegion whole = region.bridged(map, {0, 0}, {0, 2}, 0);
  EXPECT_EQ(whole.bridge_area(), 2U);  // the door and the one pixel that the region lacks behind it
  EXPECT_EQ(region.bridge_area(), 0U);
  EXPECT_TRUE(whole.connected());
}

/// The highest threshold at which start and goal are joined, by trying all there are.
float sinking_threshold(const OccupancyMap& map, const std::vector<float>& probability, Pixel start, Pixel goal) {
  for (int step = 255; step >= 0; --step) {
    std::vector<Cell> cells = map.cells();
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const bool end = k == map.index(start) || k == map.index(goal);
      if (!end && static_cast<int>(probability[k] * 256.0F) < step) cells[k] = Cell::occupied;
    }
    if (test::flood(map.with_cells(cells), start)[map.index(goal)] != 0) return static_cast<float>(step) / 256.0F;
  }
  return -1.0F;
}

TEST(PromisingRegion, ALinkIsTheWayOfASinkingThreshold) {
  Random random(42);
  int linked = 0;
  for (int i = 0; i < 60; ++i) {
    const OccupancyMap map = test::random_map(random, 3, 20);
    const Pixel start = OccupancyMap::pixel_of(test::random_free_point(map, random));
    const Pixel goal = OccupancyMap::pixel_of(test::random_free_point(map, random));
    std::vector<float> probability(map.size());
    for (float& p : probability) p = static_cast<float>(random.uniform(0.0, 0.6));
    const PromisingRegion region(map, probability, start, goal);
    const PromisingRegion result = region.linked(map, start, goal, 0.0F, 0);
    const float threshold = sinking_threshold(map, probability, start, goal);
    EXPECT_EQ(result.connected(), region.connected() || (threshold >= 0.0F && start != goal));
    EXPECT_EQ(result.area(), region.area() + result.link_area());
    for (int r = 0; r < map.height(); ++r) {
      for (int c = 0; c < map.width(); ++c) {
        const std::size_t k = map.index({c, r});
        ASSERT_GE(result.mask()[k], region.mask()[k]);
        if (result.mask()[k] == region.mask()[k]) continue;
        ASSERT_TRUE(map.is_free({c, r}));
        const bool end = Pixel{c, r} == start || Pixel{c, r} == goal;
        EXPECT_TRUE(end || static_cast<int>(probability[k] * 256.0F) >= static_cast<int>(threshold * 256.0F));
      }
    }
    linked += static_cast<int>(result.link_area() > 0);
  }
  EXPECT_GT(linked, 10);
}

TEST(PromisingRegion, NothingBelowTheLowestProbabilityIsLinked) {
  const OccupancyMap map = test::map_from_rows({"....."});
  const PromisingRegion region(map, {0.9F, 0.3F, 0.1F, 0.3F, 0.9F}, {0, 0}, {4, 0});
  EXPECT_FALSE(region.linked(map, {0, 0}, {4, 0}, 0.2F).connected());
  EXPECT_EQ(region.linked(map, {0, 0}, {4, 0}, 0.2F).link_area(), 0U);
  EXPECT_TRUE(region.linked(map, {0, 0}, {4, 0}, 0.1F).connected());
  EXPECT_THROW(region.linked(map, {0, 0}, {4, 0}, 1.5F), RequestError);
  EXPECT_THROW(region.linked(map, {0, 0}, {4, 0}, 0.1F, -1), RequestError);
  EXPECT_THROW(region.linked(test::map_from_rows({"."}), {0, 0}, {0, 0}, 0.1F), RequestError);
}

TEST(PromisingRegion, OnlyLoosePartsAreDropped) {
  Random random(43);
  int dropped = 0;
  for (int i = 0; i < 200; ++i) {
    const OccupancyMap map = test::random_map(random, 3, 20);
    const Pixel start = OccupancyMap::pixel_of(test::random_free_point(map, random));
    const Pixel goal = OccupancyMap::pixel_of(test::random_free_point(map, random));
    std::vector<float> probability(map.size());
    for (float& p : probability) p = static_cast<float>(random.uniform(0.2, 1.0));
    const PromisingRegion whole(map, probability, start, goal);
    PromisingRegion region = whole;
    region.drop_loose_parts(start);
    EXPECT_EQ(region.connected(), whole.connected());
    EXPECT_EQ(region.area(),
              static_cast<std::size_t>(std::count(region.mask().begin(), region.mask().end(), std::uint8_t{1})));
    if (!whole.connected()) {
      EXPECT_EQ(region.mask(), whole.mask());
      continue;
    }
    std::vector<Cell> cells = map.cells();
    for (std::size_t k = 0; k < cells.size(); ++k) cells[k] = whole.mask()[k] != 0 ? Cell::free : Cell::occupied;
    const std::vector<std::uint8_t> expected = test::flood(map.with_cells(cells), start);
    for (std::size_t k = 0; k < cells.size(); ++k) EXPECT_EQ(region.mask()[k] != 0, expected[k] != 0);
    dropped += static_cast<int>(region.area() < whole.area());
  }
  EXPECT_GT(dropped, 5);
}

TEST(PromisingRegion, SizesAndThresholdsAreChecked) {
  const OccupancyMap map = test::map_from_rows({".."});
  EXPECT_THROW(PromisingRegion(map, {1.0F}, {0, 0}, {1, 0}), RequestError);
  EXPECT_THROW(PromisingRegion(map, {1.0F, 1.0F}, {0, 0}, {1, 0}, 0.0F), RequestError);
  EXPECT_THROW(PromisingRegion(map, {1.0F, 1.0F}, {0, 0}, {1, 0}, 1.5F), RequestError);
}

TEST(Picture, HighlightsTheRegionOnTheMap) {
  const OccupancyMap map = test::map_from_rows({".#.", "..."});
  const PromisingRegion region(map, {1, 1, 0, 0, 0, 0}, {0, 0}, {2, 1});
  const std::vector<std::uint8_t> picture = rgb_picture(map, region);
  ASSERT_EQ(picture.size(), 18U);
  EXPECT_EQ((Rgb{picture[0], picture[1], picture[2]}), Colours{}.promising);
  EXPECT_EQ((Rgb{picture[3], picture[4], picture[5]}), Colours{}.obstacle);
  EXPECT_EQ((Rgb{picture[6], picture[7], picture[8]}), Colours{}.free);
  EXPECT_THROW(rgb_picture(test::map_from_rows({"."}), region), RequestError);
}

}  // namespace
}  // namespace lrrt
