// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <climits>
#include <cmath>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "lrrt/io/read_map.hpp"
#include "lrrt/map/map_server.hpp"
#include "reader_support.hpp"

namespace lrrt {
namespace {

using testing::contains;
using testing::map_error_of;
using testing::TemporaryFolder;
using Cells = std::vector<Cell>;

constexpr Cell free_cell = Cell::free;
constexpr Cell occupied = Cell::occupied;
constexpr Cell unknown = Cell::unknown;

/// Fields of a valid YAML file, to be changed by a test.
std::map<std::string, std::string> valid_fields() {
  return {{"image", "map.pgm"}, {"resolution", "0.05"},      {"origin", "[-1.5, 2.0, 0.25]"},
          {"negate", "0"},      {"occupied_thresh", "0.65"}, {"free_thresh", "0.196"}};
}

std::string to_yaml(const std::map<std::string, std::string>& fields) {
  std::string text;
  for (const auto& [key, value] : fields) text += key + ": " + value + "\n";
  return text;
}

MapServerMeta parse_with(const std::string& field, const std::string& value) {
  auto fields = valid_fields();
  fields[field] = value;
  return parse_map_server(to_yaml(fields), "maps/office.yaml");
}

Cells cells_of(const Image& image, const MapServerMeta& meta) {
  return interpret(image, meta).cells();
}

MapServerMeta meta_with(MapServerMode mode, double free_thresh = 0.196, double occupied_thresh = 0.65) {
  MapServerMeta meta;
  meta.mode = mode;
  meta.free_thresh = free_thresh;
  meta.occupied_thresh = occupied_thresh;
  return meta;
}

TEST(ParseMapServer, ReadsEveryField) {
  const auto meta = parse_with("mode", "scale");
  EXPECT_EQ(meta.source, "maps/office.yaml");
  EXPECT_EQ(meta.image, "maps/map.pgm");
  EXPECT_EQ(meta.resolution, 0.05);
  EXPECT_EQ(meta.origin.x, -1.5);
  EXPECT_EQ(meta.origin.y, 2.0);
  EXPECT_EQ(meta.origin.yaw, 0.25);
  EXPECT_FALSE(meta.negate);
  EXPECT_EQ(meta.occupied_thresh, 0.65);
  EXPECT_EQ(meta.free_thresh, 0.196);
  EXPECT_EQ(meta.mode, MapServerMode::scale);
}

TEST(ParseMapServer, ModeIsOptionalAndOtherFieldsAreIgnored) {
  const auto meta = parse_with("map_type", "occupancy");
  EXPECT_EQ(meta.mode, MapServerMode::trinary);
  EXPECT_EQ(parse_with("mode", "raw").mode, MapServerMode::raw);
  EXPECT_EQ(parse_with("mode", "trinary").mode, MapServerMode::trinary);
}

TEST(ParseMapServer, NegateIsANumberOrAWord) {
  for (const std::string yes : {"1", "true", "True", "1.0"}) EXPECT_TRUE(parse_with("negate", yes).negate) << yes;
  for (const std::string no : {"0", "false", "no"}) EXPECT_FALSE(parse_with("negate", no).negate) << no;
}

TEST(ParseMapServer, AbsoluteImagePathsStay) {
  EXPECT_EQ(parse_with("image", "/somewhere/map.png").image, "/somewhere/map.png");
  EXPECT_EQ(parse_with("image", "\"with space.png\"").image, "maps/with space.png");
}

TEST(ParseMapServer, EachRequiredFieldIsMissed) {
  for (const auto& [field, value] : valid_fields()) {
    auto fields = valid_fields();
    fields.erase(field);
    const std::string error = map_error_of([&] { parse_map_server(to_yaml(fields), "maps/office.yaml"); });
    EXPECT_TRUE(contains(error, "maps/office.yaml: field '" + field + "' is missing; expected")) << error;
  }
}

TEST(ParseMapServer, WrongValuesAreNamed) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"image", "[a, b]"},
      {"image", "''"},
      {"resolution", "fine"},
      {"resolution", "0"},
      {"resolution", "-0.05"},
      {"resolution", ".nan"},
      {"resolution", ".inf"},
      {"resolution", "[0.05]"},
      {"resolution", "0.05 m"},
      {"origin", "0"},
      {"origin", "[0, 0]"},
      {"origin", "[0, 0, 0, 0]"},
      {"origin", "[0, .nan, 0]"},
      {"origin", "[0, 0, east]"},
      {"origin", "{x: 0}"},
      {"negate", "2"},
      {"negate", "maybe"},
      {"negate", "[0]"},
      {"free_thresh", "-0.01"},
      {"free_thresh", "x"},
      {"free_thresh", "0.7"},
      {"occupied_thresh", "1.5"},
      {"occupied_thresh", "65"},
      {"occupied_thresh", ".nan"},
      {"mode", "ternary"},
      {"mode", "[scale]"},
      {"mode", "''"},
  };
  for (const auto& [field, value] : cases) {
    const std::string error = map_error_of([&f = field, &v = value] { parse_with(f, v); });
    EXPECT_TRUE(contains(error, "maps/office.yaml: field '" + field + "' is "))
        << field << ": " << value << ": " << error;
    EXPECT_TRUE(contains(error, "; expected ")) << error;
  }
}

TEST(ParseMapServer, BrokenYamlIsNamedWithItsLine) {
  const std::string error = map_error_of([] { parse_map_server("image: a.pgm\norigin: [0, 0\n", "m.yaml"); });
  EXPECT_TRUE(contains(error, "m.yaml: line ")) << error;
  for (const std::string text : {"", "just words", "- a\n- b\n"}) {
    EXPECT_TRUE(contains(map_error_of([&] { parse_map_server(text, "m.yaml"); }), "m.yaml: not a map_server file"));
  }
}

TEST(ParseMapServer, ThresholdsMayMeetAndReachTheEnds) {
  auto fields = valid_fields();
  fields["free_thresh"] = "0.0";
  fields["occupied_thresh"] = "1.0";
  EXPECT_EQ(parse_map_server(to_yaml(fields), "m.yaml").occupied_thresh, 1.0);
  fields["free_thresh"] = fields["occupied_thresh"] = "0.5";
  EXPECT_EQ(parse_map_server(to_yaml(fields), "m.yaml").free_thresh, 0.5);
}

TEST(Interpret, TrinarySplitsTheUsualGreys) {
  const Image image{5, 1, 1, {0, 89, 100, 205, 254}};
  // occupancies 1, 0.651, 0.608, 0.19608, 0.004
  EXPECT_EQ(cells_of(image, meta_with(MapServerMode::trinary)),
            (Cells{occupied, occupied, unknown, unknown, free_cell}));
}

TEST(Interpret, AThresholdItselfIsUnknown) {
  // 204 is occupancy 51/255 = 0.2 and 51 is 0.8, exactly as the literals below.
  const Image image{6, 1, 1, {203, 204, 205, 50, 51, 52}};
  for (const auto mode : {MapServerMode::trinary, MapServerMode::scale}) {
    EXPECT_EQ(cells_of(image, meta_with(mode, 0.2, 0.8)),
              (Cells{unknown, unknown, free_cell, occupied, unknown, unknown}));
  }
}

TEST(Interpret, EveryGreyLevelFollowsTheFormula) {
  for (const bool negate : {false, true}) {
    auto meta = meta_with(MapServerMode::trinary, 0.25, 0.65);
    meta.negate = negate;
    for (int grey = 0; grey < 256; ++grey) {
      const double p = negate ? grey / 255.0 : (255 - grey) / 255.0;
      const Cell expected = p > 0.65 ? occupied : p < 0.25 ? free_cell : unknown;
      const auto level = static_cast<std::uint8_t>(grey);
      EXPECT_EQ(cells_of({1, 1, 1, {level}}, meta), Cells{expected}) << grey;
      EXPECT_EQ(cells_of({1, 1, 3, {level, level, level}}, meta), Cells{expected}) << grey;
    }
  }
}

TEST(Interpret, ColorsAreAveraged) {
  // (255 + 255 + 0) / 3 = 170, occupancy 1/3.
  const Image image{1, 1, 3, {255, 255, 0}};
  EXPECT_EQ(cells_of(image, meta_with(MapServerMode::trinary, 0.34, 0.65)), Cells{free_cell});
  EXPECT_EQ(cells_of(image, meta_with(MapServerMode::trinary, 0.33, 0.65)), Cells{unknown});
}

TEST(Interpret, TrinaryAveragesAlphaAsAFourthChannel) {
  const auto meta = meta_with(MapServerMode::trinary);
  // Opaque black: (0 + 0 + 0 + 255) / 4 = 63.75, occupancy 0.75. Clear white: 191.25, occupancy 0.25.
  const Image color{3, 1, 4, {0, 0, 0, 255, 255, 255, 255, 0, 255, 255, 255, 255}};
  EXPECT_EQ(cells_of(color, meta), (Cells{occupied, unknown, free_cell}));
  const Image grey{3, 1, 2, {0, 255, 255, 0, 255, 255}};
  EXPECT_EQ(cells_of(grey, meta), (Cells{occupied, unknown, free_cell}));
  EXPECT_EQ(cells_of(grey, meta_with(MapServerMode::trinary, 0.196, 0.75)), (Cells{unknown, unknown, free_cell}));
}

TEST(Interpret, ScaleTakesAnyTransparencyAsUnknown) {
  const auto meta = meta_with(MapServerMode::scale, 0.196, 0.8);
  // Opaque black is fully occupied here: alpha is not averaged.
  const Image color{4, 1, 4, {0, 0, 0, 255, 0, 0, 0, 254, 255, 255, 255, 0, 255, 255, 255, 255}};
  EXPECT_EQ(cells_of(color, meta), (Cells{occupied, unknown, unknown, free_cell}));
  const Image grey{4, 1, 2, {0, 255, 0, 254, 255, 0, 255, 255}};
  EXPECT_EQ(cells_of(grey, meta), (Cells{occupied, unknown, unknown, free_cell}));
}

TEST(Interpret, RawIsAPercentageThatIgnoresNegateAndAlpha) {
  auto meta = meta_with(MapServerMode::raw, 0.2, 0.65);
  const Image image{8, 1, 1, {0, 19, 20, 65, 66, 100, 101, 255}};
  const Cells expected = {free_cell, free_cell, unknown, unknown, occupied, occupied, unknown, unknown};
  EXPECT_EQ(cells_of(image, meta), expected);
  meta.negate = true;
  EXPECT_EQ(cells_of(image, meta), expected);
  EXPECT_EQ(cells_of({2, 1, 4, {0, 0, 0, 0, 100, 100, 100, 7}}, meta), (Cells{free_cell, occupied}));
  EXPECT_EQ(cells_of({2, 1, 3, {100, 100, 101, 101, 101, 100}}, meta), (Cells{occupied, unknown}));  // 100.3, 100.7
}

TEST(Interpret, RefusesInconsistentInput) {
  EXPECT_NE(map_error_of([] { interpret({2, 1, 1, {0}}, MapServerMeta{}); }), "");
  MapServerMeta meta;
  meta.resolution = -1.0;
  EXPECT_NE(map_error_of([&] { interpret({1, 1, 1, {0}}, meta); }), "");
}

TEST(Interpret, RowsAreFlippedIntoTheMapFrame) {
  // 3×2 pixels, only the lower left one occupied.
  const Image image{3, 2, 1, {255, 255, 255, 0, 255, 255}};
  auto meta = meta_with(MapServerMode::trinary);
  meta.resolution = 0.5;
  meta.origin = {10.0, 20.0, 0.0};
  const auto map = interpret(image, meta);
  EXPECT_TRUE(map.is_metric());
  EXPECT_EQ(map.at({0, 1}), occupied);
  EXPECT_TRUE(map.center({0, 1}).isApprox(Eigen::Vector2d(10.25, 20.25)));
  EXPECT_TRUE(map.center({2, 0}).isApprox(Eigen::Vector2d(11.25, 20.75)));
  EXPECT_EQ(OccupancyMap::pixel_of(map.to_pixel({10.1, 20.1})), (Pixel{0, 1}));
}

TEST(Interpret, YawTurnsTheMapAroundItsLowerLeftCorner) {
  auto meta = meta_with(MapServerMode::trinary);
  meta.resolution = 1.0;
  meta.origin = {5.0, 7.0, std::acos(-1.0) / 2.0};
  const auto map = interpret({3, 2, 1, {255, 255, 255, 255, 255, 0}}, meta);
  // The lower right pixel lies 2.5 m along the picture's x axis, which points along the map's y axis now.
  EXPECT_EQ(map.at({2, 1}), occupied);
  EXPECT_TRUE(map.center({2, 1}).isApprox(Eigen::Vector2d(4.5, 9.5)));
  EXPECT_EQ(OccupancyMap::pixel_of(map.to_pixel({4.5, 9.5})), (Pixel{2, 1}));
}

TEST(ReadMapServer, ReadsTheFixture) {
  const auto map = read_map(std::filesystem::path(LRRT_TEST_DATA) / "room.yaml");
  ASSERT_EQ(map.width(), 8);
  ASSERT_EQ(map.height(), 6);
  EXPECT_EQ(map.at({0, 0}), unknown);
  EXPECT_EQ(map.at({7, 0}), occupied);
  EXPECT_EQ(map.at({7, 4}), free_cell);
  EXPECT_EQ(map.at({3, 2}), occupied);
  EXPECT_TRUE(map.center({7, 4}).isApprox(Eigen::Vector2d(1.75, -0.25)));
}

TEST(ReadMapServer, FindsRelativeAndAbsoluteImages) {
  const TemporaryFolder folder;
  auto fields = valid_fields();
  cv::Mat picture(2, 3, CV_8UC4, cv::Scalar(255, 255, 255, 255));
  picture.at<cv::Vec4b>(1, 2) = {0, 0, 0, 255};
  std::filesystem::create_directories(folder / "pictures");
  ASSERT_TRUE(cv::imwrite((folder / "pictures/map.png").string(), picture));
  for (const std::string& image : {std::string("pictures/map.png"), (folder / "pictures/map.png").string(),
                                   std::string("../" + folder.path().filename().string() + "/pictures/map.png")}) {
    fields["image"] = image;
    const auto map = read_map(folder.write("map.yaml", to_yaml(fields)));
    EXPECT_EQ(map.cells(), (Cells{free_cell, free_cell, free_cell, free_cell, free_cell, occupied})) << image;
  }
}

TEST(ReadMapServer, NumbersBeyondTheMapsBoundsNameFileAndField) {
  const TemporaryFolder folder;
  folder.write("map.pgm", "P5 1 1 255\nx");
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"resolution", "1e-30"},      {"resolution", "1e30"},       {"resolution", "0"},
      {"resolution", "-0.05"},      {"resolution", ".nan"},       {"resolution", ".inf"},
      {"origin", "[1e10, 0, 0]"},   {"origin", "[0, -1e300, 0]"}, {"origin", "[0, 0, .nan]"},
      {"occupied_thresh", "1e300"}, {"free_thresh", ".inf"},      {"free_thresh", "-1"}};
  for (const auto& [field, value] : cases) {
    auto fields = valid_fields();
    fields[field] = value;
    const auto file = folder.write("map.yaml", to_yaml(fields));
    const std::string error = map_error_of([&, &f = file] { read_map(f); });
    EXPECT_TRUE(contains(error, file.string() + ": field '" + field + "'")) << error << " for " << value;
  }
}

TEST(ReadMapServer, OnlyRegularFilesOfAReasonableSizeAreRead) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const std::string& image : {std::string("pipe"), std::string("/dev/zero"), std::string(".")}) {
    auto fields = valid_fields();
    fields["image"] = image;
    const auto file = folder.write("map.yaml", to_yaml(fields));
    EXPECT_TRUE(contains(map_error_of([&] { read_map(file); }), "field 'image'")) << image;
  }
  for (const char* name : {"a.yaml", "a.map", "a.png"}) {
    ASSERT_EQ(mkfifo((folder / name).c_str(), 0600), 0);
    EXPECT_TRUE(contains(map_error_of([&, n = name] { read_map(folder / n); }), "not a regular file")) << name;
  }
  for (const auto& [name, size] : {std::pair{"b.yaml", 1 << 21}, std::pair{"b.png", INT_MAX}}) {
    const auto file = folder.write(name, "");
    std::filesystem::resize_file(file, static_cast<std::uintmax_t>(size) + 1);  // holes: it takes no space
    EXPECT_TRUE(contains(map_error_of([&, &f = file] { read_map(f); }), "too many")) << name;
  }
}

TEST(ReadMapServer, NamesBothFilesWhenTheImageIsMissingOrBroken) {
  const TemporaryFolder folder;
  const auto file = folder.write("map.yaml", to_yaml(valid_fields()));
  const std::string missing = map_error_of([&] { read_map(file); });
  EXPECT_TRUE(contains(missing, file.string() + ": field 'image'")) << missing;
  EXPECT_TRUE(contains(missing, (folder / "map.pgm").string())) << missing;

  const auto picture = folder.write("map.pgm", "P5 9 9 255\nshort");
  const std::string broken = map_error_of([&] { read_map(file); });
  EXPECT_TRUE(contains(broken, picture.string())) << broken;
}

}  // namespace
}  // namespace lrrt
