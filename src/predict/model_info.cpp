// SPDX-License-Identifier: BSD-3-Clause
#include "model_info.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>

#include "lrrt/error.hpp"
#include "lrrt/predict/onnx_predictor.hpp"
#include "own_path.hpp"

namespace lrrt {
namespace {

/// The metadata layout that this library reads.
constexpr const char* metadata_format = "1";

class Reader {
 public:
  Reader(const std::filesystem::path& path, const MetadataLookup& lookup) : path_(path), lookup_(lookup) {}

  [[noreturn]] void fail(const std::string& key, const std::string& problem) const {
    throw ModelError("model " + path_.string() + ": metadata '" + key + "' " + problem +
                     ". Export the model with this project's training package, which writes it.");
  }

  std::string text(const std::string& key) const {
    const std::optional<std::string> value = lookup_(key);
    if (!value) fail(key, "is missing");
    return *value;
  }

  std::string optional_text(const std::string& key) const { return lookup_(key).value_or(""); }

  double number(const std::string& key, double low, double high) const {
    const std::string value = text(key);
    std::istringstream stream(value);
    double result = 0.0;
    if (!(stream >> result) || !stream.eof() || !(result >= low && result <= high)) {
      std::ostringstream expected;
      expected << "is '" << value << "', expected a number from " << low << " to " << high;
      fail(key, expected.str());
    }
    return result;
  }

  int whole(const std::string& key, int low, int high) const {
    const double value = number(key, low, high);
    if (value != std::floor(value)) fail(key, "is '" + text(key) + "', expected a whole number");
    return static_cast<int>(value);
  }

 private:
  const std::filesystem::path& path_;
  const MetadataLookup& lookup_;
};

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> parts;
  std::istringstream stream(list);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

/// Sides below `size`, ascending; none where the metadata do not name any.
std::vector<int> read_smaller(const Reader& reader, int size) {
  std::vector<int> sides;
  for (const std::string& part : split(reader.optional_text("smaller_inputs"))) {
    int side = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), side);
    const bool whole = error == std::errc() && end == part.data() + part.size();
    if (!whole || side < 8 || side >= size || (!sides.empty() && side <= sides.back())) {
      reader.fail("smaller_inputs", "is '" + reader.text("smaller_inputs") + "', expected ascending sides from 8 to " +
                                        std::to_string(size - 1) + ", separated by commas");
    }
    sides.push_back(side);
  }
  return sides;
}

/// True for a whole number from 0 to 255; what does not fit would be cut to it.
bool is_level(const nlohmann::json& value) {
  return value.is_number_integer() && value >= 0 && value <= 255;
}

Colours read_colours(const Reader& reader) {
  const std::string text = reader.text("colours");
  try {
    const auto json = nlohmann::json::parse(text);
    const auto colour = [&](const char* key) {
      const nlohmann::json& levels = json.at(key);
      const bool fits = levels.is_array() && levels.size() == 3 && std::all_of(levels.begin(), levels.end(), is_level);
      if (!fits) reader.fail("colours", std::string("has a '") + key + "' that is not three numbers from 0 to 255");
      return levels.get<Rgb>();
    };
    return {colour("start"), colour("goal"), colour("free"), colour("obstacle"), colour("promising")};
  } catch (const nlohmann::json::exception& error) {
    reader.fail("colours", std::string("is not an object of [red, green, blue] lists (") + error.what() + ")");
  }
}

std::vector<std::string> read_classes(const Reader& reader, int size) {
  constexpr std::int64_t most_values = std::int64_t{1} << 28;  // of one output: a gigabyte
  std::vector<std::string> classes = split(reader.text("classes"));
  if (std::count(classes.begin(), classes.end(), "promising") != 1) {
    reader.fail("classes", "is '" + reader.text("classes") + "', expected a list with one 'promising' in it");
  }
  if (static_cast<std::int64_t>(classes.size()) > most_values / (std::int64_t{size} * size)) {
    reader.fail("classes", "names " + std::to_string(classes.size()) + " classes for an input of " +
                               std::to_string(size) + "×" + std::to_string(size) + " pixels, expected at most " +
                               std::to_string(most_values) + " values in one output");
  }
  return classes;
}

}  // namespace

ModelInfo read_model_info(const std::filesystem::path& path, const MetadataLookup& lookup) {
  const Reader reader(path, lookup);
  if (reader.text("lrrt_format") != metadata_format) {
    reader.fail("lrrt_format", "is '" + reader.text("lrrt_format") + "', this library reads '" + metadata_format + "'");
  }
  ModelInfo info;
  info.path = path;
  info.name = reader.text("name");
  info.input.size = reader.whole("input_size", 8, 8192);
  info.input.smaller = read_smaller(reader, info.input.size);
  if (!info.input.smaller.empty()) info.input.least_passage = reader.number("least_passage", 1.0, info.input.size);
  const int least_side = info.input.smaller.empty() ? info.input.size : info.input.smaller.front();
  info.input.marker_side = reader.whole("marker_side", 1, least_side);
  info.input.colours = read_colours(reader);
  info.classes = read_classes(reader, info.input.size);
  const auto promising = std::find(info.classes.begin(), info.classes.end(), "promising");
  info.promising = static_cast<std::size_t>(promising - info.classes.begin());
  info.threshold = static_cast<float>(reader.number("threshold", 1e-6, 1.0));
  info.training_data = reader.text("training_data");
  info.training_budget = reader.text("training_budget");
  info.commit = reader.text("commit");
  return info;
}

std::filesystem::path default_model_path() {
  if (const char* chosen = std::getenv("LRRT_MODEL"); chosen != nullptr && *chosen != '\0') return chosen;
  // in the wheel; from liblrrt.so; from a program in bin
  std::vector<std::filesystem::path> places =
      around_own_path({"", LRRT_DATA_FROM_LIBRARY, LRRT_DATA_FROM_PROGRAM}, "models/default.onnx");
#ifdef LRRT_DEFAULT_MODEL
  places.emplace_back(LRRT_DEFAULT_MODEL);
#endif
  std::string tried;
  for (const std::filesystem::path& place : places) {
    std::error_code ignored;
    if (std::filesystem::exists(place, ignored)) return place.lexically_normal();
    tried += "\n  " + place.lexically_normal().string();
  }
  throw ModelError("the default model is not where it should be. Set LRRT_MODEL to an ONNX file, or name one. Tried:" +
                   tried);
}

}  // namespace lrrt
