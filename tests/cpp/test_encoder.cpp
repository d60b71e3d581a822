// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "lrrt/error.hpp"
#include "lrrt/predict/encoder.hpp"
#include "support.hpp"

namespace lrrt {
namespace {

/// A room of free pixels with a border of walls.
OccupancyMap room(int width, int height) {
  std::vector<Cell> cells(static_cast<std::size_t>(width * height), Cell::occupied);
  for (int r = 1; r < height - 1; ++r) {
    for (int c = 1; c < width - 1; ++c) cells[static_cast<std::size_t>(r * width + c)] = Cell::free;
  }
  return {width, height, std::move(cells)};
}

Rgb pixel_at(const std::vector<std::uint8_t>& image, int size, int c, int r) {
  const auto plane = static_cast<std::size_t>(size * size);
  const auto i = static_cast<std::size_t>(r * size + c);
  return {image[i], image[plane + i], image[2 * plane + i]};
}

TEST(Encoder, PaintsThePapersColoursAndOneBlockPerMarker) {
  std::vector<std::uint8_t> image;
  const InputFit fit = Encoder({64, 5, {}}).encode(room(8, 8), {1.5, 1.5}, {6.5, 5.5}, image);
  EXPECT_EQ(fit.scale, 8.0);
  const Colours colours;
  EXPECT_EQ(pixel_at(image, 64, 0, 0), colours.obstacle);
  EXPECT_EQ(pixel_at(image, 64, 3 * 8, 3 * 8), colours.free);
  for (const int offset : {0, 7}) {
    EXPECT_EQ(pixel_at(image, 64, 8 + offset, 8 + offset), colours.start);
    EXPECT_EQ(pixel_at(image, 64, 48 + offset, 40 + offset), colours.goal);
  }
  const auto red = std::count(image.begin(), image.begin() + 64 * 64, 255);
  EXPECT_EQ(red, 36 * 64 - 64);  // every free pixel but the goal's block has full red
  EXPECT_EQ(pixel_at(image, 64, 16, 8), colours.free);
}

TEST(Encoder, SmallPixelsGetAMarkerOfTheStatedSide) {
  std::vector<std::uint8_t> image;
  Encoder({64, 5, {}}).encode(room(60, 60), {30.5, 30.5}, {10.5, 10.5}, image);
  int marked = 0;
  for (int r = 0; r < 64; ++r) {
    for (int c = 0; c < 64; ++c) marked += static_cast<int>(pixel_at(image, 64, c, r) == Colours{}.start);
  }
  EXPECT_EQ(marked, 25);
}

InputSpec several_sizes() {
  InputSpec spec{64, 5, {}};
  spec.smaller = {16, 32};
  spec.least_passage = 4.0;
  return spec;
}

/// A room of 64 pixels a side, cut in two by a wall with a door.
OccupancyMap two_rooms(int door) {
  OccupancyMap map = room(64, 64);
  std::vector<Cell> cells = map.cells();
  for (int r = 1; r < 63; ++r) {
    if (r < 20 || r >= 20 + door) cells[map.index({30, r})] = cells[map.index({31, r})] = Cell::occupied;
  }
  return {64, 64, std::move(cells)};
}

TEST(Encoder, TakesTheSmallestInputThatKeepsPassagesWide) {
  const Encoder encoder(several_sizes());
  std::vector<std::uint8_t> image;
  for (const auto& [door, side] : {std::pair{1, 64}, std::pair{7, 64}, std::pair{8, 32}, std::pair{15, 32},
                                   std::pair{16, 16}, std::pair{40, 16}}) {
    const InputFit fit = encoder.encode(two_rooms(door), {10.5, 10.5}, {50.5, 50.5}, image);
    EXPECT_EQ(fit.size, side) << "door of " << door;
    EXPECT_EQ(image.size(), static_cast<std::size_t>(3 * side * side));
    std::vector<std::uint8_t> alone;
    Encoder({side, 5, {}}).encode(two_rooms(door), {10.5, 10.5}, {50.5, 50.5}, alone);
    EXPECT_EQ(image, alone) << "door of " << door;  // as if there were no other side
  }
}

bool all_free(const OccupancyMap& map, int c, int r, int side) {
  for (int dr = 0; dr < side; ++dr) {
    for (int dc = 0; dc < side; ++dc) {
      if (!map.is_free({c + dc, r + dr})) return false;
    }
  }
  return true;
}

TEST(Encoder, ASquareOfTheStatedWidthFitsInEveryPassageThatIsShownSmaller) {
  const Encoder encoder(several_sizes());
  Random random(7);
  std::vector<std::uint8_t> image;
  int smaller = 0;
  for (int i = 0; i < 300; ++i) {
    const OccupancyMap map = test::random_map(random, 1, 24);
    const InputFit fit =
        encoder.encode(map, test::random_free_point(map, random), test::random_free_point(map, random), image);
    if (fit.size == 64) continue;
    ++smaller;
    const int side = static_cast<int>(std::ceil(4.0 / fit.scale));  // at least, map pixels
    for (int r = fit.crop.r; r < fit.crop.r + fit.crop.height; ++r) {
      for (int c = fit.crop.c; c < fit.crop.c + fit.crop.width; ++c) {
        if (!map.is_free({c, r})) continue;
        bool covered = false;
        for (int dr = 0; dr < side && !covered; ++dr) {
          for (int dc = 0; dc < side && !covered; ++dc) covered = all_free(map, c - dc, r - dr, side);
        }
        ASSERT_TRUE(covered) << "map " << i << ", pixel " << c << ' ' << r;
      }
    }
  }
  EXPECT_GT(smaller, 10);
}

TEST(Encoder, PassagesThatScalingMakesGreyCountToo) {
  InputSpec spec = several_sizes();
  std::vector<std::uint8_t> image;
  for (const int door : {1, 2, 6, 40}) {
    std::vector<Cell> cells(100 * 100, Cell::free);
    for (int r = 0; r < 100; ++r) {
      for (int c = 45; c < 55 && (r < 30 || r >= 30 + door); ++c)
        cells[static_cast<std::size_t>(100 * r + c)] = Cell::occupied;
    }
    const OccupancyMap map(100, 100, std::move(cells));
    const InputFit fit = Encoder(spec).encode(map, {10.5, 10.5}, {90.5, 90.5}, image);
    EXPECT_EQ(fit.size, door < 13 ? 64 : door < 25 ? 32 : 16) << "door of " << door;
  }
}

TEST(Encoder, RefusesSizesThatMakeNoSense) {
  InputSpec spec = several_sizes();
  spec.smaller = {32, 16};
  EXPECT_THROW(Encoder{spec}, RequestError);
  spec.smaller = {64};
  EXPECT_THROW(Encoder{spec}, RequestError);
  spec.smaller = {4};
  EXPECT_THROW(Encoder{spec}, RequestError);
  spec.smaller = {32};
  spec.least_passage = 0.0;
  EXPECT_THROW(Encoder{spec}, RequestError);
}

TEST(Encoder, CropsToTheComponentThatMatters) {
  std::vector<std::string> rows(40, std::string(100, '?'));
  for (int r = 10; r < 20; ++r) rows[static_cast<std::size_t>(r)].replace(50, 10, "..........");
  rows[35][3] = '.';  // a free pixel that cannot be reached
  std::vector<std::uint8_t> image;
  const InputFit fit = Encoder({64, 5, {}}).encode(test::map_from_rows(rows), {50.5, 10.5}, {59.5, 19.5}, image);
  EXPECT_EQ(fit.crop.c, 49);
  EXPECT_EQ(fit.crop.r, 9);
  EXPECT_EQ(fit.crop.width, 12);
  EXPECT_EQ(fit.scale, 5.0);
}

TEST(Encoder, ThinPassagesSurviveScalingDown) {
  std::vector<std::string> rows(400, std::string(400, '#'));
  for (int c = 0; c < 400; ++c) rows[200][static_cast<std::size_t>(c)] = '.';
  for (int r = 0; r < 400; ++r) rows[static_cast<std::size_t>(r)][0] = '.';
  std::vector<std::uint8_t> image;
  const InputFit fit = Encoder({64, 3, {}}).encode(test::map_from_rows(rows), {0.5, 0.5}, {399.5, 200.5}, image);
  EXPECT_LT(fit.scale, 1.0);
  const int row = fit.placed.r + static_cast<int>(200.5 * fit.scale);
  for (int c = 8; c < 56; ++c) EXPECT_GT(pixel_at(image, 64, c, row)[1], 10) << c;
}

TEST(Encoder, AnySizeAndAspectRatioFits) {
  Random random(31);
  std::vector<std::uint8_t> image;
  for (int i = 0; i < 300; ++i) {
    const OccupancyMap map = test::random_map(random, 1, i % 10 == 0 ? 700 : 90);
    const Eigen::Vector2d start = test::random_free_point(map, random);
    const Eigen::Vector2d goal = test::random_free_point(map, random);
    const InputFit fit = Encoder({64, 5, {}}).encode(map, start, goal, image);
    ASSERT_EQ(image.size(), 3U * 64 * 64);
    EXPECT_GE(fit.placed.c, 0);
    EXPECT_GE(fit.placed.r, 0);
    EXPECT_LE(fit.placed.c + fit.placed.width, 64);
    EXPECT_LE(fit.placed.r + fit.placed.height, 64);
    EXPECT_TRUE(fit.placed.width > 56 || fit.placed.height > 56 || fit.scale >= 1.0);
  }
}

TEST(Encoder, TheWayBackUndoesTheWayIn) {
  Random random(32);
  std::vector<std::uint8_t> image;
  for (int i = 0; i < 50; ++i) {
    const OccupancyMap map = test::random_map(random, 4, 60);  // enlarged or copied, never scaled down
    const Eigen::Vector2d point = test::random_free_point(map, random);
    const InputFit fit = Encoder({64, 5, {}}).encode(map, point, point, image);
    std::vector<std::uint8_t> values(map.size());
    for (std::uint8_t& value : values) value = static_cast<std::uint8_t>(random.index(200));
    const std::vector<std::uint8_t> input = fit.to_input(values, 255);
    const std::vector<float> plane(input.begin(), input.end());
    const std::vector<float> back = fit.to_map(plane.data());
    for (int r = 0; r < map.height(); ++r) {
      for (int c = 0; c < map.width(); ++c) {
        const bool shown =
            c >= fit.crop.c && c < fit.crop.c + fit.crop.width && r >= fit.crop.r && r < fit.crop.r + fit.crop.height;
        ASSERT_NEAR(back[map.index({c, r})], shown ? static_cast<float>(values[map.index({c, r})]) : 0.0F, 1e-3F);
      }
    }
  }
}

TEST(Encoder, LabelsLieWhereThePictureShowsThem) {
  Random random(33);
  std::vector<std::uint8_t> image;
  for (int i = 0; i < 100; ++i) {
    // long and thin, scaled down: the shorter side is rounded
    const int width = 8 + static_cast<int>(random.index(20));
    const int height = 600 + static_cast<int>(random.index(900));
    std::vector<Cell> cells(static_cast<std::size_t>(width * height), Cell::free);
    std::vector<std::uint8_t> label(cells.size(), 0);
    const int half = height / 2;
    for (std::size_t k = static_cast<std::size_t>(half * width); k < cells.size(); ++k) label[k] = 255;
    const InputFit fit = Encoder({64, 1, {}}).encode({width, height, cells}, {0.5, 0.5}, {0.5, 0.5}, image);
    const std::vector<std::uint8_t> input = fit.to_input(label, 0);
    const std::vector<float> back = fit.to_map(std::vector<float>(input.begin(), input.end()).data());
    for (int r = 0; r < height; ++r) {
      if (std::abs(r - half) > 2.0 / fit.scale) {
        ASSERT_NEAR(back[static_cast<std::size_t>(r * width + width / 2)], r < half ? 0.0F : 255.0F, 1.0F)
            << r << " of " << height;
      }
    }
  }
}

TEST(Encoder, EndsThatAreNotFreeAreRefused) {
  std::vector<std::uint8_t> image;
  const Encoder encoder;
  EXPECT_THROW(encoder.encode(room(8, 8), {0.5, 0.5}, {6.5, 5.5}, image), RequestError);
  EXPECT_THROW(encoder.encode(room(8, 8), {1.5, 1.5}, {60.5, 5.5}, image), RequestError);
  EXPECT_THROW(Encoder({4, 5, {}}), RequestError);
  EXPECT_THROW(Encoder({64, 0, {}}), RequestError);
  EXPECT_THROW(Encoder({64, 65, {}}), RequestError);
}

}  // namespace
}  // namespace lrrt
