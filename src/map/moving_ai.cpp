// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/map/moving_ai.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <utility>

#include "file_bytes.hpp"
#include "lrrt/error.hpp"
#include "lrrt/map/image.hpp"

namespace lrrt {
namespace {

constexpr std::string_view blanks = " \t";

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 60;
  return "'" + std::string(text.substr(0, longest)) + (text.size() > longest ? "...'" : "'");
}

/// Walks over the lines of a text, counts them, and drops `\n` and `\r\n`.
class Lines {
 public:
  Lines(std::string_view text, std::string source) : rest_(text), source_(std::move(source)) {}

  /// Next line, or nothing at the end of the text.
  std::optional<std::string_view> next() {
    if (rest_.empty()) return std::nullopt;
    const std::size_t end = rest_.find('\n');
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    ++number_;
    return line;
  }

  /// Next line, which must exist.
  std::string_view require(const std::string& expected) {
    const auto line = next();
    if (!line) {
      throw MapError(source_ + ": ends after line " + std::to_string(number_) + "; expected " + expected +
                     "; is the file cut off?");
    }
    return *line;
  }

  [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
    throw MapError(source_ + ": line " + std::to_string(number_) + ": found " + found + "; expected " + expected +
                   "; correct that line");
  }

  const std::string& source() const { return source_; }

 private:
  std::string_view rest_;
  std::string source_;
  int number_ = 0;
};

std::vector<std::string_view> split(std::string_view line, std::string_view separators) {
  std::vector<std::string_view> words;
  std::size_t begin = line.find_first_not_of(separators);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(separators, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(separators, end);
  }
  return words;
}

int to_int(const Lines& lines, std::string_view word, const std::string& expected) {
  int value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || value < 0) lines.fail(in_quotes(word), expected);
  return value;
}

double to_length(const Lines& lines, std::string_view word) {
  const std::string text(word);
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end != text.c_str() + text.size() || !std::isfinite(value) || value < 0.0) {
    lines.fail(in_quotes(word), "the optimal length, a number not below 0");
  }
  return value;
}

struct Size {
  int width = 0;
  int height = 0;
};

Size read_map_header(Lines& lines) {
  const std::string expected_type = "`type octile`";
  const auto type = lines.require(expected_type);
  if (split(type, blanks) != std::vector<std::string_view>{"type", "octile"})
    lines.fail(in_quotes(type), expected_type);
  Size size;
  const std::string expected_side = "`height` and `width`, each with a positive whole number, and then `map`";
  for (auto line = lines.require(expected_side); split(line, blanks) != std::vector<std::string_view>{"map"};
       line = lines.require(expected_side)) {
    const auto words = split(line, blanks);
    if (words.size() != 2 || (words[0] != "height" && words[0] != "width")) lines.fail(in_quotes(line), expected_side);
    (words[0] == "height" ? size.height : size.width) = to_int(lines, words[1], expected_side);
  }
  check_map_size(size.width, size.height, lines.source());
  return size;
}

Cell to_cell(const Lines& lines, char letter, std::size_t column) {
  switch (letter) {
    case '.':
    case 'G':
    case 'S':
      return Cell::free;
    case '@':
    case 'O':
    case 'T':
    case 'W':
      return Cell::occupied;
    default:
      lines.fail(in_quotes({&letter, 1}) + " in column " + std::to_string(column + 1),
                 "one of . G S (free) or @ O T W (occupied)");
  }
}

void expect_only_blank_lines(Lines& lines, int height) {
  while (const auto line = lines.next()) {
    if (!split(*line, blanks).empty()) {
      lines.fail(in_quotes(*line), "nothing after the " + std::to_string(height) + " rows of the map");
    }
  }
}

void expect_version_1(Lines& lines) {
  const std::string expected = "`version 1`";
  const auto line = lines.require(expected);
  const auto words = split(line, blanks);
  if (words.size() != 2 || words[0] != "version" || (words[1] != "1" && words[1] != "1.0")) {
    lines.fail(in_quotes(line), expected);
  }
}

Pixel to_pixel(const Lines& lines, std::string_view column, std::string_view row, const Scenario& scenario) {
  const std::string expected = "a column and a row inside the " + std::to_string(scenario.width) + "×" +
                               std::to_string(scenario.height) + " map";
  const Pixel pixel{to_int(lines, column, expected), to_int(lines, row, expected)};
  if (pixel.c >= scenario.width || pixel.r >= scenario.height) {
    lines.fail(in_quotes(std::string(column) + " " + std::string(row)), expected);
  }
  return pixel;
}

Scenario to_scenario(const Lines& lines, std::string_view line) {
  // Tabs separate the fields in published files, where the map's name may hold spaces.
  const auto words = split(line, line.find('\t') == std::string_view::npos ? blanks : std::string_view("\t"));
  if (words.size() != 9) {
    lines.fail(std::to_string(words.size()) + " fields",
               "9: bucket, map, width, height, start column and row, goal column and row, optimal length");
  }
  Scenario scenario;
  scenario.bucket = to_int(lines, words[0], "the bucket, a whole number not below 0");
  scenario.map = std::string(words[1]);
  scenario.width = to_int(lines, words[2], "the map's width in pixels");
  scenario.height = to_int(lines, words[3], "the map's height in pixels");
  scenario.start = to_pixel(lines, words[4], words[5], scenario);
  scenario.goal = to_pixel(lines, words[6], words[7], scenario);
  scenario.optimal_length = to_length(lines, words[8]);
  return scenario;
}

}  // namespace

OccupancyMap parse_moving_ai_map(const std::string& text, const std::string& source) {
  Lines lines(text, source);
  const auto [width, height] = read_map_header(lines);
  const std::string expected = std::to_string(height) + " rows of " + std::to_string(width) + " characters";
  std::vector<Cell> cells;
  for (int row = 0; row < height; ++row) {
    const std::string_view line = lines.require(expected);
    if (line.size() != static_cast<std::size_t>(width)) {
      lines.fail("a row of " + std::to_string(line.size()) + " characters", expected);
    }
    for (std::size_t column = 0; column < line.size(); ++column) cells.push_back(to_cell(lines, line[column], column));
  }
  expect_only_blank_lines(lines, height);
  return OccupancyMap(width, height, std::move(cells));
}

std::vector<Scenario> parse_scenarios(const std::string& text, const std::string& source) {
  Lines lines(text, source);
  expect_version_1(lines);
  std::vector<Scenario> scenarios;
  while (const auto line = lines.next()) {
    if (!split(*line, blanks).empty()) scenarios.push_back(to_scenario(lines, *line));
  }
  return scenarios;
}

OccupancyMap read_moving_ai_map(const std::filesystem::path& path) {
  return parse_moving_ai_map(detail::read_bytes(path), path.string());
}

std::vector<Scenario> read_scenarios(const std::filesystem::path& path) {
  constexpr std::uintmax_t longest = 1 << 28;  // bytes: millions of problems
  return parse_scenarios(detail::read_bytes(path, longest), path.string());
}

}  // namespace lrrt
