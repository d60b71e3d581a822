// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "lrrt/map/moving_ai.hpp"
#include "reader_support.hpp"

namespace lrrt {
namespace {

using testing::contains;
using testing::map_error_of;
using testing::TemporaryFolder;

const std::filesystem::path data = LRRT_TEST_DATA;

std::string with_windows_line_ends(const std::string& text) {
  std::string result;
  for (const char letter : text) result += letter == '\n' ? std::string("\r\n") : std::string(1, letter);
  return result;
}

TEST(MovingAiMap, EveryLetterHasItsMeaning) {
  const auto map = parse_moving_ai_map("type octile\nheight 1\nwidth 7\nmap\n.GS@OTW\n", "m.map");
  EXPECT_FALSE(map.is_metric());
  for (int c = 0; c < 7; ++c) EXPECT_EQ(map.at({c, 0}), c < 3 ? Cell::free : Cell::occupied) << c;
}

TEST(MovingAiMap, RandomGridsComeBack) {
  std::mt19937 generator(3);
  for (int round = 0; round < 50; ++round) {
    const int width = 1 + static_cast<int>(generator() % 30);
    const int height = 1 + static_cast<int>(generator() % 30);
    std::string text = "type octile\nheight " + std::to_string(height) + "\nwidth " + std::to_string(width) + "\nmap\n";
    std::vector<Cell> cells;
    for (int r = 0; r < height; ++r) {
      for (int c = 0; c < width; ++c) {
        cells.push_back(generator() % 2 == 0 ? Cell::free : Cell::occupied);
        text += cells.back() == Cell::free ? '.' : '@';
      }
      text += '\n';
    }
    for (const auto& version : {text, with_windows_line_ends(text), text + "\n \n", text.substr(0, text.size() - 1)}) {
      const auto map = parse_moving_ai_map(version, "random.map");
      ASSERT_EQ(map.width(), width);
      ASSERT_EQ(map.height(), height);
      ASSERT_EQ(map.cells(), cells);
    }
  }
}

TEST(MovingAiMap, HeaderMayNameTheWidthFirst) {
  const auto map = parse_moving_ai_map("type octile\nwidth 2\nheight 1\nmap\n.@\n", "m.map");
  EXPECT_EQ(map.width(), 2);
  EXPECT_EQ(map.height(), 1);
}

TEST(MovingAiMap, FaultsNameFileAndLine) {
  const std::string header = "type octile\nheight 2\nwidth 3\nmap\n";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "m.map: ends after line 0"},
      {"type hex\nheight 1\n", "m.map: line 1: found 'type hex'"},
      {"type octile\nheight two\n", "m.map: line 2: found 'two'"},
      {"type octile\nheight -2\n", "m.map: line 2: found '-2'"},
      {"type octile\nheight 99999999999\n", "m.map: line 2: found '99999999999'"},
      {"type octile\nheight 2\ndepth 3\n", "m.map: line 3: found 'depth 3'"},
      {"type octile\nheight 2\nwidth 3\n", "m.map: ends after line 3"},
      {"type octile\nheight 2\nmap\n", "m.map: size 0×2"},
      {"type octile\nheight 200000\nwidth 200000\nmap\n", "m.map: size 200000×200000 is too large"},
      {header + "...\n", "m.map: ends after line 5"},
      {header + "...\n..\n", "m.map: line 6: found a row of 2 characters"},
      {header + "....\n...\n", "m.map: line 5: found a row of 4 characters"},
      {header + "...\n.x.\n", "m.map: line 6: found 'x' in column 2"},
      {header + "...\n...\n...\n", "m.map: line 7: found '...'"},
  };
  for (const auto& [text, fault] : cases) {
    for (const auto& version : {text, with_windows_line_ends(text)}) {
      const std::string error = map_error_of([&] { parse_moving_ai_map(version, "m.map"); });
      EXPECT_TRUE(contains(error, fault)) << error << "\nfor\n" << version;
      EXPECT_TRUE(contains(error, "; expected ")) << error;
    }
  }
}

TEST(Scenarios, ReadsTheFixturesTogether) {
  const auto map = read_moving_ai_map(data / "room.map");
  const auto scenarios = read_scenarios(data / "room.scen");
  ASSERT_EQ(scenarios.size(), 2U);
  EXPECT_EQ(scenarios[0].map, "room.map");
  EXPECT_EQ(scenarios[1].bucket, 2);
  EXPECT_EQ(scenarios[1].start, (Pixel{1, 1}));
  EXPECT_EQ(scenarios[1].goal, (Pixel{7, 4}));
  EXPECT_NEAR(scenarios[0].optimal_length, 2.0 + std::sqrt(2.0), 1e-8);
  for (const auto& scenario : scenarios) {
    EXPECT_EQ(scenario.width, map.width());
    EXPECT_EQ(scenario.height, map.height());
    EXPECT_TRUE(map.is_free(scenario.start));
    EXPECT_TRUE(map.is_free(scenario.goal));
  }
}

TEST(Scenarios, ToleratesSpacesWindowsLineEndsAndTheLongVersion) {
  const std::string tabs = "version 1.0\n4\tmaps/two words.map\t9\t5\t0\t1\t8\t4\t9.5\n\n";
  for (const auto& text : {tabs, with_windows_line_ends(tabs)}) {
    const auto scenarios = parse_scenarios(text, "s.scen");
    ASSERT_EQ(scenarios.size(), 1U);
    EXPECT_EQ(scenarios[0].map, "maps/two words.map");
    EXPECT_EQ(scenarios[0].optimal_length, 9.5);
  }
  const auto spaced = parse_scenarios("version 1\n0 a.map 9 5 0 1 8 4 9.5", "s.scen");
  ASSERT_EQ(spaced.size(), 1U);
  EXPECT_EQ(spaced[0].goal, (Pixel{8, 4}));
  EXPECT_TRUE(parse_scenarios("version 1\n", "s.scen").empty());
}

TEST(Scenarios, FaultsNameFileAndLine) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "s.scen: ends after line 0"},
      {"version 2\n", "s.scen: line 1: found 'version 2'"},
      {"0 a.map 9 5 0 1 8 4 9.5\n", "s.scen: line 1: found "},
      {"version 1\n0 a.map 9 5 0 1 8 4\n", "s.scen: line 2: found 8 fields"},
      {"version 1\n\n0 a.map 9 5 0 1 8 4 9.5 7\n", "s.scen: line 3: found 10 fields"},
      {"version 1\nzero a.map 9 5 0 1 8 4 9.5\n", "s.scen: line 2: found 'zero'"},
      {"version 1\n0 a.map 9 5 9 1 8 4 9.5\n", "s.scen: line 2: found '9 1'"},
      {"version 1\n0 a.map 9 5 0 1 8 5 9.5\n", "s.scen: line 2: found '8 5'"},
      {"version 1\n0 a.map 9 5 0 1 8 1.5 9.5\n", "s.scen: line 2: found '1.5'"},
      {"version 1\n0 a.map 9 5 0 1 8 4 long\n", "s.scen: line 2: found 'long'"},
      {"version 1\n0 a.map 9 5 0 1 8 4 nan\n", "s.scen: line 2: found 'nan'"},
      {"version 1\n0 a.map 9 5 0 1 8 4 -1\n", "s.scen: line 2: found '-1'"},
  };
  for (const auto& [text, fault] : cases) {
    const std::string error = map_error_of([&t = text] { parse_scenarios(t, "s.scen"); });
    EXPECT_TRUE(contains(error, fault)) << error << "\nfor\n" << text;
    EXPECT_TRUE(contains(error, "; expected ")) << error;
  }
}

TEST(MovingAiFiles, MissingFilesAreNamed) {
  const TemporaryFolder folder;
  EXPECT_TRUE(contains(map_error_of([&] { read_moving_ai_map(folder / "no.map"); }), (folder / "no.map").string()));
  EXPECT_TRUE(contains(map_error_of([&] { read_scenarios(folder / "no.scen"); }), (folder / "no.scen").string()));
}

}  // namespace
}  // namespace lrrt
