// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "fields.hpp"
#include "given_maps.hpp"
#include "lrrt/io/read_map.hpp"
#include "lrrt/map/components.hpp"
#include "maze.hpp"
#include "support.hpp"

namespace lrrt::bench {
namespace {

constexpr const char* drawn_maps = LRRT_BENCH_SUITES "/../maps";

OccupancyMap noise(int width, int height, double free, Random& random) {
  std::vector<Cell> cells(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (Cell& cell : cells) cell = random.uniform() < free ? Cell::free : Cell::occupied;
  cells[cells.size() / 2] = Cell::free;
  return {width, height, std::move(cells)};
}

TEST(MapsIn, AFolderGivesItsMapsAndAFileItself) {
  EXPECT_EQ(maps_in(std::string(drawn_maps) + "/rooms").size(), 4U);
  EXPECT_EQ(maps_in(std::string(drawn_maps) + "/rooms/0.png").size(), 1U);
  EXPECT_EQ(maps_below(drawn_maps).size(), 24U);
  EXPECT_THROW(maps_in(drawn_maps), SuiteError);
  EXPECT_THROW(maps_below("/nowhere/at/all"), SuiteError);
}

TEST(MapsIn, AFolderThatCannotBeReadIsNamed) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("lrrt_maps_" + std::to_string(getpid()));
  fs::create_directories(folder / "locked");
  fs::permissions(folder / "locked", fs::perms::none);
  const uid_t user = geteuid();
  ASSERT_EQ(user == 0 ? seteuid(65534) : 0, 0);  // root may read everything
  for (const fs::path& asked : {folder, folder / "locked"}) {
    try {
      maps_below(asked);
      ADD_FAILURE() << "expected a SuiteError";
    } catch (const SuiteError& error) {
      EXPECT_NE(std::string(error.what()).find((folder / "locked").string() + " cannot be read"), std::string::npos)
          << error.what();
    }
  }
  ASSERT_EQ(seteuid(user), 0);
  fs::permissions(folder / "locked", fs::perms::owner_all);
  fs::remove_all(folder);
}

TEST(Resized, EveryPixelIsTheNearestOne) {
  Random random(1);
  const OccupancyMap map = noise(30, 17, 0.6, random);
  for (const int pixels : {90, 30, 41, 7}) {
    const OccupancyMap other = resized(map, pixels);
    EXPECT_EQ(other.width(), pixels);
    EXPECT_EQ(other.height(), std::lround(17.0 * pixels / 30));
    for (int r = 0; r < other.height(); ++r) {
      for (int c = 0; c < other.width(); ++c) {
        const Pixel there{static_cast<int>((c + 0.5) * 30 / other.width()),
                          static_cast<int>((r + 0.5) * 17 / other.height())};
        ASSERT_EQ(other.at({c, r}), map.at(there));
      }
    }
  }
  EXPECT_EQ(resized(map, 30).cells(), map.cells());
  EXPECT_FALSE(resized(map, 90).is_metric());
}

TEST(Resized, MetresStayWhereTheyWere) {
  const OccupancyMap map(40, 20, std::vector<Cell>(800, Cell::free), 0.05, {-1.0, 2.0, 0.3});
  for (const int pixels : {80, 10}) {
    const OccupancyMap other = resized(map, pixels);
    EXPECT_NEAR(other.resolution(), 0.05 * 40 / pixels, 1e-12);
    for (const double x : {0.0, 13.0, 40.0}) {
      const Eigen::Vector2d there = map.to_world({x, 7.0});
      EXPECT_LT((other.to_pixel(there) - Eigen::Vector2d(x, 7.0) * pixels / 40.0).norm(), 1e-9);
    }
  }
}

class Mosaic : public testing::TestWithParam<int> {};

TEST_P(Mosaic, HangsTogetherAndShowsItsMaps) {
  const auto seed = static_cast<std::uint64_t>(GetParam());
  Random random(seed);
  const std::vector<OccupancyMap> maps = {noise(30, 20, 0.7, random), noise(90, 150, 0.65, random),
                                          noise(64, 64, 0.3, random)};
  const MosaicLayout layout{200, 48, 5};
  const OccupancyMap mosaic = mosaic_of(maps, layout, random);
  EXPECT_EQ(mosaic.width(), 200);
  EXPECT_EQ(mosaic.height(), 200);
  EXPECT_EQ(Components(mosaic).count(), 1);
  const auto free = std::count(mosaic.cells().begin(), mosaic.cells().end(), Cell::free);
  EXPECT_GT(free, 1000);
  EXPECT_LT(free, 39000);
  for (int i = 0; i < 200; ++i) {
    for (const Pixel p : {Pixel{i, 0}, Pixel{0, i}, Pixel{i, 199}, Pixel{199, i}}) EXPECT_FALSE(mosaic.is_free(p));
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Mosaic, testing::Range(0, 20));

TEST(Mosaic, TheSameSeedGivesTheSameMosaicAndAnotherAnotherOne) {
  const std::vector<OccupancyMap> maps = {read_map(std::string(drawn_maps) + "/rooms/0.png"),
                                          read_map(std::string(drawn_maps) + "/city/0.png")};
  const auto made = [&](std::uint64_t seed) {
    Random random(seed);
    return mosaic_of(maps, {512, 128, 8}, random).cells();
  };
  EXPECT_EQ(made(3), made(3));
  EXPECT_NE(made(3), made(4));
}

TEST(Mosaic, OfAMapWithoutFreePixelsIsRefused) {
  Random random(1);
  EXPECT_THROW(mosaic_of({OccupancyMap(40, 40, std::vector<Cell>(1600, Cell::occupied))}, {200, 48, 5}, random),
               MapError);
}

}  // namespace
}  // namespace lrrt::bench
