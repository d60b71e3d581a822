// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <thread>

#include "lrrt/error.hpp"
#include "lrrt/predict/grid_predictors.hpp"
#include "lrrt/predict/onnx_predictor.hpp"
#include "many_support.hpp"

namespace lrrt {
namespace {

std::filesystem::path tiny(const std::string& name) {
  return std::filesystem::path(LRRT_TEST_DATA) / "models" / (name + ".onnx");
}

/// A narrow maze beside a large room, with a wall between them: queries in one and in the other take pictures of
/// different sides.
OccupancyMap maze_and_room() {
  std::vector<std::string> rows(64, std::string(128, '.'));
  for (std::size_t r = 0; r < 64; ++r) {
    for (std::size_t c = 0; c < 60; ++c) {
      if (r % 4 != 0 && c % 4 != 0) rows[r][c] = '#';
    }
    for (std::size_t c = 60; c < 64; ++c) rows[r][c] = '#';
  }
  return test::map_from_rows(rows);
}

TEST(PredictMany, GivesTheRegionsOfPredictInOrder) {
  for (const char* name : {"green", "two_classes", "one_class", "single"}) {
    const OnnxPredictor predictor(tiny(name));
    Random random(81);
    for (int i = 0; i < 12; ++i) {
      const OccupancyMap map = test::random_map(random, 1, 60);
      test::expect_one_by_one(predictor, map, test::random_queries(map, random.index(20), random));
    }
  }
}

TEST(PredictMany, MixesPicturesOfDifferentSides) {
  const OnnxPredictor predictor(tiny("sizes"));
  Random random(82);
  std::set<int> sides;
  for (int i = 0; i < 30; ++i) {
    const OccupancyMap map = test::random_map(random, 1, i % 2 == 0 ? 60 : 12);
    sides.merge(test::expect_one_by_one(predictor, map, test::random_queries(map, 1 + random.index(24), random)));
  }
  EXPECT_EQ(sides, (std::set<int>{8, 16, 32}));
}

/// Every sum in the model that ships is one of whole numbers, which batches do not change; the last step is not.
TEST(PredictMany, TheDefaultModelMarksTheSame) {
  const OnnxPredictor predictor;
  const OccupancyMap map = maze_and_room();
  Random random(83);
  const auto sides = test::expect_one_by_one(predictor, map, test::random_queries(map, 19, random), 1e-5F);
  EXPECT_GE(sides.size(), 2U);
}

TEST(PredictMany, PredictorsWithoutANetworkGoOneByOne) {
  Random random(84);
  for (int i = 0; i < 10; ++i) {
    const OccupancyMap map = test::random_map(random, 2, 40);
    const std::vector<RegionQuery> queries = test::random_queries(map, 7, random);
    EXPECT_EQ(test::expect_one_by_one(AStarPredictor(), map, queries), std::set<int>{0});
    test::expect_one_by_one(PotentialFieldPredictor(), map, queries);
    test::expect_one_by_one(GivenRegion(map.width(), map.height(), std::vector<float>(map.size(), 0.7F)), map, queries);
  }
}

TEST(PredictMany, NoQueriesGiveNoPredictions) {
  const OccupancyMap map = test::map_from_rows({"##", "##"});
  EXPECT_TRUE(OnnxPredictor(tiny("green")).predict_many(map, {}).empty());
  EXPECT_TRUE(AStarPredictor().predict_many(map, {}).empty());
}

TEST(PredictMany, AWrongQueryIsNamed) {
  const OccupancyMap map = test::map_from_rows({"..#.", "...."});
  const RegionQuery good{{0.5, 0.5}, {3.5, 1.5}};
  const OnnxPredictor network(tiny("green"));
  const AStarPredictor grid;
  for (const RegionPredictor* predictor : std::vector<const RegionPredictor*>{&network, &grid}) {
    std::vector<RegionQuery> queries(12, good);
    queries[9].goal = {50.5, 0.5};
    EXPECT_EQ(test::refusal_of(*predictor, map, queries).find("queries[9]: goal (50.5, 0.5)"), 0U);
    queries[3].start = {2.5, 0.5};
    EXPECT_EQ(test::refusal_of(*predictor, map, queries).find("queries[3]: start (2.5, 0.5)"), 0U);
    EXPECT_EQ(predictor->predict_many(map, {good}).size(), 1U);
  }
}

TEST(PredictMany, TimesOfTheNetworkAreSharesOfItsCalls) {
  const OnnxPredictor predictor(tiny("green"));
  const OccupancyMap map = test::map_from_rows({"....", "...."});
  const std::vector<RegionQuery> queries(20, {{0.5, 0.5}, {3.5, 1.5}});
  const std::vector<Prediction> many = predictor.predict_many(map, queries);
  for (std::size_t i = 0; i < many.size(); ++i) {
    EXPECT_GT(many[i].timings.encode, 0.0);
    EXPECT_GT(many[i].timings.region, 0.0);
    EXPECT_GT(many[i].timings.infer, 0.0);
    EXPECT_EQ(many[i].timings.infer, many[i / 8 * 8].timings.infer);  // eight at once
  }
}

TEST(PredictMany, OneModelServesManyThreads) {
  const OnnxPredictor predictor(tiny("sizes"));
  Random random(85);
  const OccupancyMap map = test::random_map(random, 40, 60);
  const std::vector<RegionQuery> queries = test::random_queries(map, 20, random);
  const std::vector<Prediction> expected = predictor.predict_many(map, queries);
  std::vector<int> equal(6, 0);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < equal.size(); ++i) {
    threads.emplace_back([&, i] {
      for (std::size_t k = 0; k < 20; ++k) {
        const std::vector<RegionQuery> some(queries.begin() + static_cast<std::ptrdiff_t>(k), queries.end());
        const std::vector<Prediction> many = predictor.predict_many(map, some);
        equal[i] += static_cast<int>(std::equal(
            many.begin(), many.end(), expected.begin() + static_cast<std::ptrdiff_t>(k), expected.end(),
            [](const Prediction& a, const Prediction& b) { return a.region.probability() == b.region.probability(); }));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(equal, std::vector<int>(equal.size(), 20));
}

}  // namespace
}  // namespace lrrt
