// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <string>
#include <vector>

#include "lrrt/io/read_map.hpp"
#include "lrrt/map/image.hpp"
#include "lrrt/map/read_map.hpp"
#include "reader_support.hpp"

namespace lrrt {
namespace {

using testing::contains;
using testing::map_error_of;
using testing::TemporaryFolder;
using Pixels = std::vector<std::uint8_t>;
using Cells = std::vector<Cell>;

Image random_image(int width, int height, int channels, unsigned seed) {
  Image image{width, height, channels, Pixels(static_cast<std::size_t>(width * height * channels))};
  std::mt19937 generator(seed);
  for (auto& value : image.pixels) value = static_cast<std::uint8_t>(generator() % 256);
  return image;
}

/// The picture in OpenCV's channel order.
cv::Mat bgr(const Image& image) {
  cv::Mat mat(image.height, image.width, CV_8UC(image.channels));
  std::copy(image.pixels.begin(), image.pixels.end(), mat.data);
  if (image.channels < 3) return mat;
  for (std::size_t i = 0; i < mat.total(); ++i) {
    std::uint8_t* pixel = mat.data + i * static_cast<std::size_t>(image.channels);
    std::swap(pixel[0], pixel[2]);
  }
  return mat;
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

TEST(MapFromImage, GreyIsOccupiedBelowHalf) {
  const auto map = map_from_image({4, 1, 1, {0, 127, 128, 255}});
  EXPECT_EQ(map.cells(), (Cells{Cell::occupied, Cell::occupied, Cell::free, Cell::free}));
  EXPECT_FALSE(map.is_metric());
}

TEST(MapFromImage, ColorsCountByLuminance) {
  // Pure green is brighter than half, pure red and pure blue are darker.
  const auto map = map_from_image({3, 1, 3, {255, 0, 0, 0, 255, 0, 0, 0, 255}});
  EXPECT_EQ(map.cells(), (Cells{Cell::occupied, Cell::free, Cell::occupied}));
}

TEST(MapFromImage, OnlyFullTransparencyIsUnknown) {
  const auto grey = map_from_image({4, 1, 2, {0, 0, 255, 0, 0, 1, 255, 254}});
  EXPECT_EQ(grey.cells(), (Cells{Cell::unknown, Cell::unknown, Cell::occupied, Cell::free}));
  const auto color = map_from_image({2, 1, 4, {255, 255, 255, 0, 255, 255, 255, 1}});
  EXPECT_EQ(color.cells(), (Cells{Cell::unknown, Cell::free}));
}

TEST(MapFromImage, RefusesInconsistentImages) {
  EXPECT_TRUE(contains(map_error_of([] { map_from_image({2, 2, 1, Pixels(3)}); }), "3 pixel values; expected"));
  EXPECT_TRUE(contains(map_error_of([] { map_from_image({1, 1, 5, Pixels(5)}); }), "channels is 5"));
  EXPECT_TRUE(contains(map_error_of([] { map_from_image({0, 4, 1, {}}); }), "0×4"));
  EXPECT_TRUE(contains(map_error_of([] { map_from_image({1 << 20, 1 << 20, 1, {}}); }), "too large"));
}

TEST(CheckMapSize, AcceptsTheLimitAndNoMore) {
  EXPECT_EQ(map_error_of([] { check_map_size(16384, 16384, "m"); }), "");
  EXPECT_NE(map_error_of([] { check_map_size(16384, 16385, "m"); }), "");
  EXPECT_NE(map_error_of([] { check_map_size(INT64_MAX, INT64_MAX, "m"); }), "");
  EXPECT_NE(map_error_of([] { check_map_size(-1, 1, "m"); }), "");
}

TEST(DecodeImage, LosslessFormatsGiveBackEveryPixel) {
  const TemporaryFolder folder;
  const std::vector<std::pair<std::string, int>> kinds = {{".png", 1}, {".png", 3}, {".png", 4}, {".pgm", 1},
                                                          {".ppm", 3}, {".bmp", 1}, {".bmp", 3}};
  unsigned seed = 0;
  for (const auto& [extension, channels] : kinds) {
    const Image image = random_image(37, 23, channels, ++seed);
    const auto file = folder / ("picture" + extension);
    ASSERT_TRUE(cv::imwrite(file.string(), bgr(image)));
    const Image read = decode_image(file);
    EXPECT_EQ(read.width, 37) << extension;
    EXPECT_EQ(read.height, 23) << extension;
    EXPECT_EQ(read.channels, channels) << extension;
    EXPECT_EQ(read.pixels, image.pixels) << extension << " with " << channels << " channels";
  }
}

TEST(DecodeImage, JpegKeepsBlackAndWhiteApart) {
  const TemporaryFolder folder;
  cv::Mat mat(16, 32, CV_8UC1, cv::Scalar(255));
  mat.colRange(0, 16).setTo(cv::Scalar(0));
  const auto file = folder / "map.jpg";
  ASSERT_TRUE(cv::imwrite(file.string(), mat));
  const auto map = read_map(file);
  for (int r = 0; r < 16; ++r) {
    for (int c = 0; c < 32; ++c) EXPECT_EQ(map.at({c, r}), c < 16 ? Cell::occupied : Cell::free);
  }
}

TEST(DecodeImage, SixteenBitsBecomeEight) {
  const TemporaryFolder folder;
  cv::Mat mat(1, 4, CV_16UC1);
  const std::vector<std::uint16_t> values = {0, 257, 128 * 257 + 128, 65535};
  std::copy(values.begin(), values.end(), mat.ptr<std::uint16_t>(0));
  ASSERT_TRUE(cv::imwrite((folder / "deep.png").string(), mat));
  EXPECT_EQ(decode_image(folder / "deep.png").pixels, (Pixels{0, 1, 128, 255}));

  cv::Mat color(1, 1, CV_16UC3, cv::Scalar(3 * 257, 2 * 257, 1 * 257));
  ASSERT_TRUE(cv::imwrite((folder / "deep_color.png").string(), color));
  EXPECT_EQ(decode_image(folder / "deep_color.png").pixels, (Pixels{1, 2, 3}));
}

TEST(DecodeImage, ResolvesPalettesWithTransparency) {
  // 2×1 pixels; palette (10, 20, 30) opaque and (200, 100, 50) with alpha 0.
  static constexpr unsigned char palette_png[] = {
      0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00,
      0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x01, 0x08, 0x03, 0x00, 0x00, 0x00, 0xc3, 0xfc, 0x8f, 0xb8, 0x00,
      0x00, 0x00, 0x06, 0x50, 0x4c, 0x54, 0x45, 0x0a, 0x14, 0x1e, 0xc8, 0x64, 0x32, 0x77, 0xa0, 0xb3, 0x9c,
      0x00, 0x00, 0x00, 0x02, 0x74, 0x52, 0x4e, 0x53, 0xff, 0x00, 0xe5, 0xb7, 0x30, 0x4a, 0x00, 0x00, 0x00,
      0x0b, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x60, 0x60, 0x04, 0x00, 0x00, 0x04, 0x00, 0x02, 0xbf,
      0x7a, 0x3f, 0x4a, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  const TemporaryFolder folder;
  const auto file = folder.write("palette.png", {reinterpret_cast<const char*>(palette_png), sizeof(palette_png)});
  const Image image = decode_image(file);
  EXPECT_EQ(image.channels, 4);
  EXPECT_EQ(image.pixels, (Pixels{10, 20, 30, 255, 200, 100, 50, 0}));
}

TEST(DecodeImage, ResolvesAGreyThatStandsForTransparent) {
  const std::filesystem::path folder = LRRT_TEST_DATA;
  const auto cells = [&](const char* name) { return read_map(folder / name).cells(); };
  EXPECT_EQ(cells("transparent_grey_4.png"), (Cells{Cell::occupied, Cell::unknown, Cell::unknown, Cell::occupied}));
  EXPECT_EQ(cells("transparent_grey_8.png"), (Cells{Cell::occupied, Cell::occupied, Cell::free, Cell::unknown}));
  EXPECT_EQ(cells("transparent_grey_16.png"), (Cells{Cell::unknown, Cell::free, Cell::occupied, Cell::unknown}));
}

TEST(DecodeImage, ResolvesGreyWithAlpha) {
  // 2×1 pixels, PNG colour type 4: (40, 255) and (90, 7).
  static constexpr unsigned char grey_alpha_png[] = {
      0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00,
      0x00, 0x02, 0x00, 0x00, 0x00, 0x01, 0x08, 0x04, 0x00, 0x00, 0x00, 0x5e, 0x2b, 0xb7, 0x01, 0x00, 0x00, 0x00,
      0x0d, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0xd0, 0xf8, 0x1f, 0xc5, 0x0e, 0x00, 0x04, 0x5d, 0x01, 0x89,
      0x17, 0x11, 0xe2, 0xd6, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  const TemporaryFolder folder;
  const auto file = folder.write("ga.png", {reinterpret_cast<const char*>(grey_alpha_png), sizeof(grey_alpha_png)});
  const Image image = decode_image(file);
  EXPECT_EQ(image.channels, 4);
  EXPECT_EQ(image.pixels, (Pixels{40, 40, 40, 255, 90, 90, 90, 7}));
}

struct PnmCase {
  std::string name;
  std::string bytes;
  int channels;
  Pixels pixels;
};

TEST(DecodeImage, ReadsEveryAnyMap) {
  using namespace std::string_literals;
  const std::vector<PnmCase> cases = {
      {"P1", "P1\n# a comment\n3 2\n1 0 1\n010\n", 1, {0, 255, 0, 255, 0, 255}},
      {"P4", "P4\n9 2\n\xff\x80\x00\x00"s, 1, {0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 255, 255, 255, 255, 255, 255, 255, 255}},
      {"P2", "P2\r\n3 1 # width height\r\n255\r\n0 205\r\n254", 1, {0, 205, 254}},
      {"P2 to 1", "P2 2 1 1 1 0", 1, {255, 0}},
      {"P2 above maximum", "P2 2 1 10 10 11", 1, {255, 255}},
      {"P5", "P5 2 1 255\n#\n"s, 1, {35, 10}},
      {"P5 to 100", "P5\n3 1\n100\n\x64\x32\x00"s, 1, {255, 128, 0}},
      {"P5 16 bit", "P5 2 1 65535\n\xff\xff\x80\x80"s, 1, {255, 128}},
      {"P3", "P3 1 2 255 1 2 3 4 5 6", 3, {1, 2, 3, 4, 5, 6}},
      {"P6", "P6 1 1 255\nabc", 3, {'a', 'b', 'c'}},
  };
  const TemporaryFolder folder;
  for (const auto& test : cases) {
    const Image image = decode_image(folder.write("picture.pnm", test.bytes));
    EXPECT_EQ(image.channels, test.channels) << test.name;
    EXPECT_EQ(image.pixels, test.pixels) << test.name;
  }
}

TEST(DecodeImage, BrokenAnyMapsNameFileAndFault) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"P5 4 4 255\nabc", "3 bytes of pixels where 16 are expected"},
      {"P5 4 4", "ends where the largest value"},
      {"P5 4 4 0\n", "largest value is 0"},
      {"P5 4 4 65536\n", "above 65535"},
      {"P2 2 1 255\n3 -4", "a pixel is not a whole number"},
      {"P2 2 1 255\n3", "too few pixels"},
      {"P2 2 1 255\n300 ", "ends where a pixel"},
      {"P1 2 1\n1 2", "neither 0 nor 1"},
      {"P5 x 1 255\n", "the width is not a whole number"},
      {"P5 0 7 255\n", "0×7"},
      {"P5 99999999999999999999 1 255\n", "the width is above"},
      {"P5 100000 100000 255\nabc", "100000×100000 is too large"},
      {"P2 16384 16384 255\n1 2 3", "too few pixels"},
  };
  const TemporaryFolder folder;
  for (const auto& [bytes, fault] : cases) {
    const auto file = folder.write("broken.pgm", bytes);
    const std::string error = map_error_of([&file = file] { decode_image(file); });
    EXPECT_TRUE(contains(error, file.string())) << bytes << ": " << error;
    EXPECT_TRUE(contains(error, fault)) << bytes << ": " << error;
  }
}

TEST(DecodeImage, CutOffFilesAreRefused) {
  const TemporaryFolder folder;
  const Image image = random_image(40, 30, 3, 5);
  for (const std::string extension : {".png", ".bmp", ".jpg", ".ppm"}) {
    const auto file = folder / ("whole" + extension);
    ASSERT_TRUE(cv::imwrite(file.string(), bgr(image)));
    const std::string bytes = bytes_of(file);
    for (const std::size_t kept : {bytes.size() - 2, bytes.size() / 2, std::size_t{20}, std::size_t{3}}) {
      const auto part = folder.write("part" + extension, bytes.substr(0, kept));
      const std::string error = map_error_of([&] { decode_image(part); });
      EXPECT_TRUE(contains(error, part.string())) << extension << " cut to " << kept << " bytes: " << error;
    }
  }
}

TEST(DecodeImage, AbsurdSizesAreRefusedFromTheHeader) {
  const TemporaryFolder folder;
  ASSERT_TRUE(cv::imwrite((folder / "small.png").string(), cv::Mat(2, 2, CV_8UC1, cv::Scalar(0))));
  std::string bytes = bytes_of(folder / "small.png");
  for (const std::size_t at : {16U, 20U}) bytes[at] = '\x7f';
  const auto file = folder.write("absurd.png", bytes);
  EXPECT_TRUE(contains(map_error_of([&] { decode_image(file); }), "too large"));
}

TEST(DecodeImage, OtherFilesAreRefused) {
  const TemporaryFolder folder;
  EXPECT_TRUE(contains(map_error_of([&] { decode_image(folder / "absent.png"); }), "absent.png: no such file"));
  EXPECT_TRUE(contains(map_error_of([&] { decode_image(folder.path()); }), "not a regular file"));
  const auto text = folder.write("notes.png", "these are no pixels");
  EXPECT_TRUE(contains(map_error_of([&] { decode_image(text); }), "not a picture"));
  const auto empty = folder.write("empty.png", "");
  EXPECT_TRUE(contains(map_error_of([&] { decode_image(empty); }), "not a picture"));
}

TEST(WritePng, GivesBackEveryPixelAndLeavesNothingElse) {
  const TemporaryFolder folder;
  for (int channels = 1; channels <= 4; ++channels) {
    const Image image = random_image(19, 11, channels, static_cast<unsigned>(channels));
    write_png(folder / "out.png", image);
    const Image read = decode_image(folder / "out.png");
    if (channels != 2) {
      EXPECT_EQ(read.pixels, image.pixels) << channels;
      continue;
    }
    ASSERT_EQ(read.channels, 4);
    for (std::size_t i = 0; i < 19 * 11; ++i) {
      for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(read.pixels[4 * i + k], image.pixels[2 * i]);
      ASSERT_EQ(read.pixels[4 * i + 3], image.pixels[2 * i + 1]);
    }
  }
  const std::filesystem::directory_iterator files(folder.path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

TEST(WritePng, NamesTheFileThatCannotBeWritten) {
  const TemporaryFolder folder;
  const auto file = folder / "no/such/folder.png";
  EXPECT_TRUE(contains(map_error_of([&] { write_png(file, random_image(2, 2, 1, 1)); }), file.string()));
  EXPECT_NE(map_error_of([&] { write_png(folder / "bad.png", {2, 2, 1, Pixels(3)}); }), "");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(WritePng, TakesItsTemporaryFileAwayWhenItFails) {
  const TemporaryFolder folder;
  const auto taken = folder / "a_folder.png";
  std::filesystem::create_directories(taken / "inside");
  EXPECT_TRUE(contains(map_error_of([&] { write_png(taken, random_image(2, 2, 1, 1)); }), taken.string()));
  const std::filesystem::directory_iterator files(folder.path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

TEST(ReadMap, TakesPicturesByContentAndMapsByExtension) {
  const TemporaryFolder folder;
  const std::string pgm = "P5 2 1 255\n" + std::string("\xff\x00", 2);
  const Cells cells = {Cell::free, Cell::occupied};
  EXPECT_EQ(read_map(folder.write("a.pgm", pgm)).cells(), cells);
  EXPECT_EQ(read_map(folder.write("without_extension", pgm)).cells(), cells);
  EXPECT_EQ(read_map(folder.write("picture.map", pgm)).cells(), cells);
  EXPECT_EQ(read_map(folder.write("grid.MAP", "type octile\nheight 1\nwidth 2\nmap\n.@\n")).cells(), cells);
  const std::string yaml =
      "image: a.pgm\nresolution: 0.5\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
      "free_thresh: 0.196\n";
  for (const std::string name : {"m.yaml", "m.yml", "M.YAML"}) {
    const auto map = read_map(folder.write(name, yaml));
    EXPECT_EQ(map.cells(), cells) << name;
    EXPECT_EQ(map.resolution(), 0.5) << name;
  }
}

TEST(ReadMap, ExplainsFilesThatAreNoMaps) {
  const TemporaryFolder folder;
  EXPECT_TRUE(contains(map_error_of([&] { read_map(folder.write("p.scen", "version 1\n")); }), "scenario list"));
  EXPECT_TRUE(contains(map_error_of([&] { read_map(folder.write("p.map", "tipe octile\n")); }), "'type octile'"));
  EXPECT_TRUE(contains(map_error_of([&] { read_map(folder / "absent.yaml"); }), "absent.yaml"));
  EXPECT_TRUE(contains(map_error_of([&] { read_map(folder / "absent.map"); }), "absent.map"));
}

TEST(ReadMap, UsesTheDecoderOfTheCaller) {
  const ImageDecoder decode = [](const std::filesystem::path& path) {
    EXPECT_EQ(path, "anything.tiff");
    return Image{1, 1, 1, {0}};
  };
  EXPECT_EQ(read_map("anything.tiff", decode).cells(), Cells{Cell::occupied});
}

}  // namespace
}  // namespace lrrt
