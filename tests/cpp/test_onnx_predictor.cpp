// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "lrrt/error.hpp"
#include "lrrt/predict/onnx_predictor.hpp"
#include "support.hpp"

namespace lrrt {
namespace {

std::filesystem::path tiny(const std::string& name) {
  return std::filesystem::path(LRRT_TEST_DATA) / "models" / (name + ".onnx");
}

/// 16 columns and 12 rows of free pixels with one wall.
OccupancyMap hall() {
  std::vector<std::string> rows(12, std::string(16, '.'));
  for (int r = 0; r < 8; ++r) rows[static_cast<std::size_t>(r)][5] = '#';
  return test::map_from_rows(rows);
}

TEST(OnnxPredictor, ReadsTheMetadata) {
  const OnnxPredictor predictor(tiny("green"));
  const ModelInfo& info = predictor.info();
  EXPECT_EQ(info.name, "green");
  EXPECT_EQ(info.input.size, 16);
  EXPECT_EQ(info.input.marker_side, 1);
  EXPECT_EQ(info.classes, (std::vector<std::string>{"free", "obstacle", "promising"}));
  EXPECT_EQ(info.promising, 2U);
  EXPECT_FLOAT_EQ(info.threshold, 0.5F);
  EXPECT_FALSE(info.runtime_version.empty());
}

TEST(OnnxPredictor, AcceptsThePromisingClassAlone) {
  const OnnxPredictor predictor(tiny("one_class"));
  EXPECT_EQ(predictor.info().classes, std::vector<std::string>{"promising"});
  EXPECT_EQ(predictor.info().promising, 0U);
}

TEST(OnnxPredictor, BringsTheNetworksOutputBackToTheMap) {
  for (const char* name : {"green", "two_classes", "one_class"}) {
    const OnnxPredictor predictor(tiny(name));
    const OccupancyMap map = hall();
    const PromisingRegion region = predictor.predict(map, {0.5, 0.5}, {15.5, 0.5}).region;
    for (int r = 0; r < 12; ++r) {
      for (int c = 0; c < 16; ++c) {
        const bool marker = r == 0 && (c == 0 || c == 15);  // red and blue have no green
        const bool expected = map.is_free({c, r}) && !marker;
        ASSERT_NEAR(region.probability()[map.index({c, r})], expected ? 1.0F : 0.0F, 1e-5F) << c << ' ' << r;
        ASSERT_EQ(region.mask()[map.index({c, r})] != 0, map.is_free({c, r}));  // a link takes in the ends
      }
    }
  }
}

TEST(OnnxPredictor, AcceptsMapsOfAnySize) {
  const OnnxPredictor fixed(tiny("green"));
  const OnnxPredictor several(tiny("sizes"));
  Random random(61);
  for (int i = 0; i < 200; ++i) {
    const OnnxPredictor& predictor = i % 2 == 0 ? fixed : several;
    const OccupancyMap map = test::random_map(random, 1, 100);
    const PromisingRegion region =
        predictor.predict(map, test::random_free_point(map, random), test::random_free_point(map, random)).region;
    EXPECT_EQ(region.probability().size(), map.size());
    for (const float p : region.probability()) ASSERT_TRUE(p >= 0.0F && p <= 1.0F);
  }
}

TEST(OnnxPredictor, EndsThatAreNotFreeAreRefused) {
  const OnnxPredictor predictor(tiny("green"));
  EXPECT_THROW(predictor.predict(hall(), {5.5, 0.5}, {0.5, 0.5}), RequestError);
  EXPECT_THROW(predictor.predict(hall(), {0.5, 0.5}, {50.5, 0.5}), RequestError);
}

TEST(OnnxPredictor, OutputsThatAreNoProbabilitiesAreRefused) {
  const std::vector<std::pair<const char*, const char*>> reasons = {
      {"nan", "nan"},
      {"infinite", "inf"},
      {"loud", "probabilities from 0 to 1"},
      {"negative", "-1"},
      {"cut_output", "failed"}};  // its graph leaves the output's sides open
  for (const auto& [name, reason] : reasons) {
    const OnnxPredictor predictor(tiny(name));
    for (int i = 0; i < 2; ++i) {  // a failure leaves nothing behind
      try {
        predictor.predict(hall(), {0.5, 0.5}, {15.5, 0.5});
        ADD_FAILURE() << name << ": expected a ModelError";
      } catch (const ModelError& error) {
        EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find(std::string(name) + ".onnx"), std::string::npos) << error.what();
      }
    }
  }
}

TEST(OnnxPredictor, OneModelServesManyThreads) {
  const OnnxPredictor predictor(tiny("green"));
  Random random(62);
  std::vector<OccupancyMap> maps;
  std::vector<std::vector<float>> expected;
  for (int i = 0; i < 8; ++i) {
    maps.push_back(test::random_map(random, 10, 60));
    expected.push_back(predictor.predict(maps.back(), {0.5, 0.5}, {0.5, 0.5}).region.probability());
  }
  std::vector<int> equal(maps.size(), 0);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    threads.emplace_back([&, i] {
      for (int k = 0; k < 50; ++k) {
        equal[i] +=
            static_cast<int>(predictor.predict(maps[i], {0.5, 0.5}, {0.5, 0.5}).region.probability() == expected[i]);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(equal, std::vector<int>(maps.size(), 50));
}

class BadModel : public ::testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(BadModel, IsRefusedWithTheReason) {
  const auto [name, reason] = GetParam();
  try {
    const OnnxPredictor predictor(tiny(name));
    FAIL() << "expected a ModelError";
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find(std::string(name) + ".onnx"), std::string::npos) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    OnnxPredictor, BadModel,
    ::testing::Values(std::pair{"missing", "does not exist"}, std::pair{"float_input", "'image'"},
                      std::pair{"other_output", "'probability'"}, std::pair{"no_size", "'input_size' is missing"},
                      std::pair{"wrong_size", "expected [-1, 3, 32, 32]"}, std::pair{"odd_size", "'many'"},
                      std::pair{"wrong_classes", "expected [-1, 4, 16, 16]"}, std::pair{"no_promising", "'promising'"},
                      std::pair{"wrong_format", "'99'"}, std::pair{"wrong_colours", "'colours'"},
                      std::pair{"wrong_threshold", "'threshold'"}, std::pair{"fixed_sizes", "expected [-1, 3, -1, -1]"},
                      std::pair{"open_classes", "[-1, -1, 16, 16]"}, std::pair{"half_output", "[-1, 3, 8, 8]"},
                      std::pair{"wrong_opset", "pset"}, std::pair{"two_promising", "'promising'"},
                      std::pair{"odd_sizes", "'16,8'"}, std::pair{"no_passage", "'least_passage' is missing"}));

TEST(OnnxPredictor, BrokenFilesAreRefused) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "lrrt_test_onnx_predictor";
  std::filesystem::create_directories(folder);
  std::ifstream source(tiny("green"), std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(source)), std::istreambuf_iterator<char>());
  for (const std::size_t length : {std::size_t{0}, std::size_t{1}, std::size_t{100}, whole.size() / 2}) {
    const std::filesystem::path path = folder / ("cut_" + std::to_string(length) + ".onnx");
    std::ofstream(path, std::ios::binary) << whole.substr(0, length);
    EXPECT_THROW(OnnxPredictor{path}, ModelError) << length;
  }
  std::ofstream(folder / "text.onnx") << "this is no model";
  EXPECT_THROW(OnnxPredictor{folder / "text.onnx"}, ModelError);
  EXPECT_THROW(OnnxPredictor{folder}, ModelError);
  std::filesystem::remove_all(folder);
}

TEST(DefaultModel, LoadsAndKeepsTheContract) {
  const OnnxPredictor predictor;
  EXPECT_EQ(predictor.info().input.colours, Colours{});
  Random random(63);
  const OccupancyMap map = test::random_map(random, 60, 100);
  const Prediction prediction =
      predictor.predict(map, test::random_free_point(map, random), test::random_free_point(map, random));
  EXPECT_EQ(prediction.region.probability().size(), map.size());
  EXPECT_GT(prediction.timings.infer, 0.0);
}

}  // namespace
}  // namespace lrrt
