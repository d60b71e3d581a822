// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/map/map_server.hpp"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <sstream>
#include <system_error>
#include <utility>

#include "file_bytes.hpp"
#include "lrrt/error.hpp"

namespace lrrt {
namespace {

std::string name_of(const std::filesystem::path& source) {
  return source.empty() ? std::string("map_server YAML") : source.string();
}

std::string text_of(const YAML::Node& node) {
  constexpr std::size_t longest = 60;
  std::ostringstream out;
  out << node;
  std::string text = out.str();
  if (text.size() > longest) text = text.substr(0, longest) + "...";
  return text.empty() ? std::string("empty") : text;
}

std::string text_of(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

/// One YAML document whose fields are read with errors that name file, field, value and expectation.
class Fields {
 public:
  Fields(const YAML::Node& root, std::string source) : root_(root), source_(std::move(source)) {
    if (!root_.IsMap()) {
      throw MapError(source_ +
                     ": not a map_server file; expected lines `field: value` with image, resolution, origin, " +
                     "negate, occupied_thresh and free_thresh");
    }
  }

  bool has(const char* field) const { return root_[field].IsDefined(); }

  [[noreturn]] void fail(const char* field, const std::string& value, const std::string& expected) const {
    throw MapError(source_ + ": field '" + field + "' is " + value + "; expected " + expected +
                   "; correct it in the file");
  }

  std::string text(const char* field, const char* expected) const {
    const YAML::Node node = require(field, expected);
    if (!node.IsScalar() || node.Scalar().empty()) fail(field, text_of(node), expected);
    return node.Scalar();
  }

  double number(const char* field, const char* expected) const {
    return number_in(require(field, expected), field, expected);
  }

  Pose2 pose(const char* field) const {
    constexpr const char* expected = "three finite numbers [x, y, yaw] in metres and radians";
    const YAML::Node node = require(field, expected);
    if (!node.IsSequence() || node.size() != 3) fail(field, text_of(node), expected);
    return {number_in(node[0], field, expected), number_in(node[1], field, expected),
            number_in(node[2], field, expected)};
  }

  bool flag(const char* field) const {
    constexpr const char* expected = "0 or 1 (or false, true)";
    const YAML::Node node = require(field, expected);
    bool value = false;
    if (node.IsScalar() && YAML::convert<bool>::decode(node, value)) return value;
    const double number = number_in(node, field, expected);
    if (number != 0.0 && number != 1.0) fail(field, text_of(node), expected);
    return number != 0.0;
  }

 private:
  YAML::Node require(const char* field, const char* expected) const {
    if (!has(field)) {
      throw MapError(source_ + ": field '" + field + "' is missing; expected " + expected + "; add it to the file");
    }
    return root_[field];
  }

  double number_in(const YAML::Node& node, const char* field, const char* expected) const {
    double value = 0.0;
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) || !std::isfinite(value)) {
      fail(field, text_of(node), expected);
    }
    return value;
  }

  YAML::Node root_;
  std::string source_;
};

MapServerMode read_mode(const Fields& fields) {
  constexpr const char* expected = "trinary, scale or raw";
  if (!fields.has("mode")) return MapServerMode::trinary;
  const std::string name = fields.text("mode", expected);
  if (name == "trinary") return MapServerMode::trinary;
  if (name == "scale") return MapServerMode::scale;
  if (name == "raw") return MapServerMode::raw;
  fields.fail("mode", "'" + name + "'", expected);
}

double read_resolution(const Fields& fields) {
  constexpr const char* expected = "a positive number of metres per pixel, from 1e-06 to 1e+06";
  const double resolution = fields.number("resolution", expected);
  const bool fits = resolution >= finest_resolution && resolution <= coarsest_resolution;
  if (!fits) fields.fail("resolution", text_of(resolution), expected);
  return resolution;
}

Pose2 read_origin(const Fields& fields) {
  const Pose2 origin = fields.pose("origin");
  for (const double coordinate : {origin.x, origin.y}) {
    if (std::abs(coordinate) > farthest_origin) {
      fields.fail("origin", text_of(coordinate), "coordinates at most 1e9 metres from zero");
    }
  }
  return origin;
}

void read_thresholds(const Fields& fields, MapServerMeta& meta) {
  constexpr const char* expected = "a number from 0 to 1";
  const auto read = [&](const char* field) {
    const double value = fields.number(field, expected);
    if (value < 0.0 || value > 1.0) fields.fail(field, text_of(value), expected);
    return value;
  };
  meta.occupied_thresh = read("occupied_thresh");
  meta.free_thresh = read("free_thresh");
  if (meta.free_thresh > meta.occupied_thresh) {
    fields.fail("free_thresh", text_of(meta.free_thresh),
                "at most occupied_thresh, which is " + text_of(meta.occupied_thresh));
  }
}

YAML::Node load(const std::string& text, const std::string& source) {
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw MapError(source + ": line " + std::to_string(error.mark.line + 1) + ": not valid YAML (" + error.msg +
                   "); expected a map_server file; correct that line");
  }
}

/// Sum of a pixel's channels against the sum that a white, opaque pixel would have: exact, so that thresholds are
/// exact.
struct Shade {
  int sum;
  int white;
};

Shade shade_of(const std::uint8_t* pixel, const Image& image, bool average_alpha) {
  const int colors = image.color_channels();
  const int rgb = colors == 1 ? 3 * pixel[0] : pixel[0] + pixel[1] + pixel[2];
  if (average_alpha && image.has_alpha()) return {rgb + pixel[colors], 4 * 255};
  return {rgb, 3 * 255};
}

Cell by_thresholds(double occupancy, const MapServerMeta& meta) {
  if (occupancy > meta.occupied_thresh) return Cell::occupied;
  if (occupancy < meta.free_thresh) return Cell::free;
  return Cell::unknown;
}

Cell classify(const std::uint8_t* pixel, const Image& image, const MapServerMeta& meta) {
  const auto [sum, white] = shade_of(pixel, image, meta.mode == MapServerMode::trinary);
  if (meta.mode == MapServerMode::raw) {
    const int percent = (2 * sum + 3) / 6;  // the average of three channels, rounded
    return percent > 100 ? Cell::unknown : by_thresholds(percent / 100.0, meta);
  }
  if (meta.mode == MapServerMode::scale && image.has_alpha() && pixel[image.color_channels()] != 255) {
    return Cell::unknown;
  }
  return by_thresholds((meta.negate ? sum : white - sum) / static_cast<double>(white), meta);
}

}  // namespace

MapServerMeta parse_map_server(const std::string& text, const std::filesystem::path& source) {
  const Fields fields(load(text, name_of(source)), name_of(source));
  MapServerMeta meta;
  meta.source = source;
  meta.image = source.parent_path() / fields.text("image", "the path of a picture");
  meta.resolution = read_resolution(fields);
  meta.origin = read_origin(fields);
  meta.negate = fields.flag("negate");
  read_thresholds(fields, meta);
  meta.mode = read_mode(fields);
  return meta;
}

OccupancyMap interpret(const Image& image, const MapServerMeta& meta) {
  check_image(image);
  std::vector<Cell> cells;
  cells.reserve(image.pixels.size() / static_cast<std::size_t>(image.channels));
  const std::uint8_t* const end = image.pixels.data() + image.pixels.size();
  for (const std::uint8_t* pixel = image.pixels.data(); pixel != end; pixel += image.channels) {
    cells.push_back(classify(pixel, image, meta));
  }
  return OccupancyMap(image.width, image.height, std::move(cells), meta.resolution, meta.origin);
}

OccupancyMap read_map_server(const std::filesystem::path& path, const ImageDecoder& decode) {
  constexpr std::uintmax_t longest = 1 << 20;  // bytes; such a file has some ten lines
  const MapServerMeta meta = parse_map_server(detail::read_bytes(path, longest), path);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(meta.image, ignored)) {
    throw MapError(path.string() + ": field 'image' leads to " + meta.image.string() +
                   ", which is not a file; expected a picture; relative paths start in the folder of the YAML file");
  }
  return interpret(decode(meta.image), meta);
}

}  // namespace lrrt
