// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "lrrt/error.hpp"
#include "predict/model_info.hpp"

namespace lrrt {
namespace {

using Metadata = std::map<std::string, std::string>;

Metadata good() {
  return {{"lrrt_format", "1"},
          {"name", "good"},
          {"input_size", "64"},
          {"smaller_inputs", "16,32"},
          {"least_passage", "5"},
          {"marker_side", "3"},
          {"classes", "free,obstacle,promising"},
          {"colours", R"({"start":[255,0,0],"goal":[0,0,255],"free":[255,255,255],"obstacle":[0,0,0],)"
                      R"("promising":[0,255,0]})"},
          {"threshold", "0.25"},
          {"training_data", ""},
          {"training_budget", ""},
          {"commit", ""}};
}

ModelInfo read(const Metadata& metadata) {
  return read_model_info("m.onnx", [&](const std::string& key) -> std::optional<std::string> {
    const auto found = metadata.find(key);
    return found != metadata.end() ? std::optional(found->second) : std::nullopt;
  });
}

std::string error_of(const std::string& key, const std::string& value) {
  Metadata metadata = good();
  metadata[key] = value;
  try {
    read(metadata);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ModelInfo, IsReadFromMetadata) {
  const ModelInfo info = read(good());
  EXPECT_EQ(info.input.smaller, (std::vector<int>{16, 32}));
  EXPECT_EQ(info.promising, 2U);
  EXPECT_EQ(info.input.colours, Colours{});
}

TEST(ModelInfo, EveryMissingKeyIsNamed) {
  for (const auto& [key, value] : good()) {
    if (key == "smaller_inputs") continue;  // the only one that may be missing
    Metadata metadata = good();
    metadata.erase(key);
    try {
      read(metadata);
      ADD_FAILURE() << key;
    } catch (const ModelError& error) {
      EXPECT_NE(std::string(error.what()).find("m.onnx: metadata '" + key + "' is missing"), std::string::npos) << key;
    }
  }
}

TEST(ModelInfo, ValuesOutOfTheirRangeAreNamed) {
  const auto colours = [](const std::string& start) {
    return R"({"start":)" + start +
           R"(,"goal":[0,0,255],"free":[255,255,255],"obstacle":[0,0,0],"promising":[0,255,0]})";
  };
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"input_size", "0"},
      {"input_size", "-64"},
      {"input_size", "nan"},
      {"input_size", "1e400"},
      {"input_size", "64.5"},
      {"input_size", "99999999999"},
      {"marker_side", "17"},
      {"least_passage", "inf"},
      {"threshold", "0"},
      {"threshold", "1.5"},
      {"threshold", "nan"},
      {"smaller_inputs", "16,,32"},
      {"smaller_inputs", "16,64"},
      {"classes", ""},
      {"classes", "free"},
      {"classes", "promising,promising"},
      {"classes", "promising" + std::string(100000, ',')},  // more values than a gigabyte holds
      {"colours", "[]"},
      {"colours", colours("[1,2]")},
      {"colours", colours("[1,2,256]")},
      {"colours", colours("[1,2,4294967296]")},
      {"colours", colours("[1,2,0.5]")},
      {"colours", colours("[1e300,0,0]")},
      {"colours", std::string(100000, '[')}};
  for (const auto& [key, value] : cases) {
    const std::string error = error_of(key, value);
    EXPECT_NE(error.find("m.onnx: metadata '" + key + "'"), std::string::npos) << key << ": " << error.substr(0, 200);
  }
}

}  // namespace
}  // namespace lrrt
