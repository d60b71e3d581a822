// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "lrrt/error.hpp"
#include "lrrt/predict/onnx_predictor.hpp"
#include "lrrt/predict/torch_predictor.hpp"
#include "many_support.hpp"

namespace lrrt {
namespace {

std::filesystem::path tiny(const std::string& file) {
  return std::filesystem::path(LRRT_TEST_DATA) / "models" / file;
}

TEST(TorchScriptPredictor, ReadsTheMetadata) {
  const TorchScriptPredictor predictor(tiny("green.pt"));
  const ModelInfo& info = predictor.info();
  EXPECT_EQ(info.path, tiny("green.pt"));
  EXPECT_EQ(info.name, "green");
  EXPECT_EQ(info.input.size, 16);
  EXPECT_EQ(info.classes, (std::vector<std::string>{"free", "obstacle", "promising"}));
  EXPECT_EQ(info.promising, 2U);
  EXPECT_FALSE(info.runtime_version.empty());
}

TEST(TorchScriptPredictor, AgreesWithOnnxRuntime) {
  Random random(71);
  for (const std::string& name : std::vector<std::string>{"green", "one_class", "sizes"}) {
    const TorchScriptPredictor torch(tiny(name + ".pt"));
    const OnnxPredictor onnx(tiny(name + ".onnx"));
    for (int i = 0; i < 100; ++i) {
      const OccupancyMap map = test::random_map(random, 1, 100);
      const Eigen::Vector2d start = test::random_free_point(map, random);
      const Eigen::Vector2d goal = test::random_free_point(map, random);
      const PromisingRegion expected = onnx.predict(map, start, goal).region;
      const PromisingRegion region = torch.predict(map, start, goal).region;
      ASSERT_EQ(region.mask(), expected.mask()) << name;
      ASSERT_EQ(region.connected(), expected.connected()) << name;
      ASSERT_EQ(region.probability().size(), map.size());
      for (std::size_t k = 0; k < map.size(); ++k) {
        ASSERT_NEAR(region.probability()[k], expected.probability()[k], 1e-5F) << name;
      }
    }
  }
}

TEST(TorchScriptPredictor, ManyPredictionsAreThoseOfOneByOne) {
  for (const char* file : {"green.pt", "one_class.pt", "sizes.pt", "single.pt", "first.pt"}) {
    const TorchScriptPredictor predictor(tiny(file));
    Random random(73);
    std::set<int> sides;
    for (int i = 0; i < 20; ++i) {
      const OccupancyMap map = test::random_map(random, 1, i % 2 == 0 ? 60 : 12);
      sides.merge(test::expect_one_by_one(predictor, map, test::random_queries(map, random.index(20), random), 1e-6F));
    }
    EXPECT_EQ(sides.size(), std::string(file) == "sizes.pt" ? 3U : 1U) << file;
  }
}

TEST(TorchScriptPredictor, AWrongQueryOfManyIsNamed) {
  const TorchScriptPredictor predictor(tiny("green.pt"));
  const OccupancyMap map = test::map_from_rows({"..#.", "...."});
  const std::vector<RegionQuery> queries{{{0.5, 0.5}, {3.5, 1.5}}, {{0.5, 0.5}, {2.5, 0.5}}};
  EXPECT_EQ(test::refusal_of(predictor, map, queries).find("queries[1]: goal (2.5, 0.5)"), 0U);
  EXPECT_TRUE(predictor.predict_many(map, {}).empty());
}

TEST(TorchScriptPredictor, OutputsThatAreNoProbabilitiesAreRefused) {
  const OccupancyMap map = test::map_from_rows({"....", "...."});
  EXPECT_THROW(TorchScriptPredictor(tiny("nan.pt")).predict(map, {0.5, 0.5}, {3.5, 1.5}), ModelError);
}

TEST(TorchScriptPredictor, OneModelServesManyThreads) {
  const TorchScriptPredictor predictor(tiny("green.pt"));
  Random random(72);
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

TEST(TorchScriptPredictor, TellsTheTimeOfItsStages) {
  const TorchScriptPredictor predictor(tiny("green.pt"));
  const Prediction prediction = predictor.predict(test::map_from_rows({"....", "...."}), {0.5, 0.5}, {3.5, 1.5});
  EXPECT_GT(prediction.timings.encode, 0.0);
  EXPECT_GT(prediction.timings.infer, 0.0);
  EXPECT_GT(prediction.timings.region, 0.0);
}

TEST(TorchScriptPredictor, BadRequestsAreRefused) {
  const TorchScriptPredictor predictor(tiny("green.pt"));
  const OccupancyMap map = test::map_from_rows({"..#.", "...."});
  EXPECT_THROW(predictor.predict(map, {2.5, 0.5}, {0.5, 0.5}), RequestError);
  EXPECT_THROW(predictor.predict(map, {0.5, 0.5}, {50.5, 0.5}), RequestError);
  EXPECT_THROW(TorchScriptPredictor(tiny("green.pt"), TorchOptions{-1}), RequestError);
}

class BadArchive : public ::testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(BadArchive, IsRefusedWithTheReason) {
  const auto [file, reason] = GetParam();
  try {
    const TorchScriptPredictor predictor(tiny(file));
    FAIL() << "expected a ModelError";
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find(file), std::string::npos) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    TorchScriptPredictor, BadArchive,
    ::testing::Values(
        std::pair{"missing.pt", "does not exist"}, std::pair{"green.onnx", "cannot be loaded by libtorch"},
        std::pair{"no_metadata.pt", "'metadata.json'"}, std::pair{"broken_metadata.pt", "no JSON object"},
        std::pair{"number_size.pt", "'input_size' is not a text"}, std::pair{"no_size.pt", "'input_size' is missing"},
        std::pair{"wrong_size.pt", "failed: "}, std::pair{"wrong_classes.pt", "expected [1, 4, 16, 16] and Float"},
        std::pair{"half_output.pt", "shape [1, 3, 8, 8]"}, std::pair{"double_output.pt", "element type Double"},
        std::pair{"two_outputs.pt", "returns a Tuple"}, std::pair{"two_inputs.pt", "takes 2 inputs"}));

TEST(TorchScriptPredictor, BrokenFilesAreRefused) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "lrrt_test_torch_predictor";
  std::filesystem::create_directories(folder);
  std::ifstream source(tiny("green.pt"), std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(source)), std::istreambuf_iterator<char>());
  for (const std::size_t length : {std::size_t{0}, std::size_t{1}, std::size_t{100}, whole.size() / 2}) {
    const std::filesystem::path path = folder / ("cut_" + std::to_string(length) + ".pt");
    std::ofstream(path, std::ios::binary) << whole.substr(0, length);
    EXPECT_THROW(TorchScriptPredictor{path}, ModelError) << length;
  }
  EXPECT_THROW(TorchScriptPredictor{folder}, ModelError);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace lrrt
