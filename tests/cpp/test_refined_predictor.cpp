// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <mutex>

#include "lrrt/error.hpp"
#include "lrrt/map/flood.hpp"
#include "lrrt/predict/grid_predictors.hpp"
#include "lrrt/predict/refined_predictor.hpp"
#include "support.hpp"

namespace lrrt {
namespace {

/// Marks the neighbourhood of the shortest path; of maps larger than it can see, only every third stretch of it.
class ShortSighted final : public RegionPredictor {
 public:
  explicit ShortSighted(int sees) : sees_(sees) {}

  Prediction predict(const OccupancyMap& map, const Eigen::Vector2d& start,
                     const Eigen::Vector2d& goal) const override {
    Prediction prediction = AStarPredictor(2.0).predict(map, start, goal);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      sides_.push_back(std::max(map.width(), map.height()));
    }
    if (std::max(map.width(), map.height()) <= sees_) return prediction;
    std::vector<float> probability = prediction.region.probability();
    for (std::size_t i = 0; i < probability.size(); ++i) {
      if ((i % static_cast<std::size_t>(map.width())) / 20 % 3 != 0) probability[i] = 0.0F;
    }
    prediction.region = PromisingRegion(map, std::move(probability), OccupancyMap::pixel_of(map.to_pixel(start)),
                                        OccupancyMap::pixel_of(map.to_pixel(goal)));
    return prediction;
  }

  std::vector<int> sides() const { return sides_; }

 private:
  int sees_;
  mutable std::mutex mutex_;
  mutable std::vector<int> sides_;
};

TEST(RefinedPredictor, SeesInPartsWhatTheWholeDoesNotShow) {
  Random random(81);
  int refined = 0;
  for (int i = 0; i < 20; ++i) {
    const OccupancyMap map = test::random_map(random, 150, 200);
    const Eigen::Vector2d start = test::random_free_point(map, random);
    const Eigen::Vector2d goal = test::random_free_point(map, random);
    const Pixel from = OccupancyMap::pixel_of(start);
    const Pixel to = OccupancyMap::pixel_of(goal);
    if (!Flood(map.free_mask(), map.width(), map.height(), from).reached(to)) continue;
    const auto inner = std::make_shared<ShortSighted>(48);
    const Prediction once = inner->predict(map, start, goal);
    const Prediction twice = RefinedPredictor(inner, {48, 100}).predict(map, start, goal);
    ASSERT_TRUE(twice.region.connected());
    for (std::size_t k = 0; k < map.size(); ++k) {
      ASSERT_TRUE(twice.region.mask()[k] == 0 || map.cells()[k] == Cell::free);
    }
    refined += static_cast<int>(!once.region.connected());
    for (std::size_t k = 2; k < inner->sides().size(); ++k) ASSERT_LE(inner->sides()[k], 48);
  }
  EXPECT_GT(refined, 5);
}

TEST(RefinedPredictor, LeavesAloneWhatFitsOrTakesTooMany) {
  const OccupancyMap map(60, 60, std::vector<Cell>(3600, Cell::free));
  const auto inner = std::make_shared<ShortSighted>(1000);
  RefinedPredictor(inner, {64, 100}).predict(map, {2.5, 2.5}, {57.5, 57.5});
  EXPECT_EQ(inner->sides(), (std::vector<int>{60}));
  RefinedPredictor(inner, {32, 1}).predict(map, {2.5, 2.5}, {57.5, 57.5});
  EXPECT_EQ(inner->sides(), (std::vector<int>{60, 60}));
  RefinedPredictor(inner, {32, 100}).predict(map, {2.5, 2.5}, {57.5, 57.5});
  EXPECT_GT(inner->sides().size(), 4U);
}

TEST(RefinedPredictor, RefusesWhatMakesNoSense) {
  const auto inner = std::make_shared<AStarPredictor>();
  EXPECT_THROW(RefinedPredictor(nullptr), RequestError);
  EXPECT_THROW(RefinedPredictor(inner, {8, 4}), RequestError);
  EXPECT_THROW(RefinedPredictor(inner, {64, 0}), RequestError);
}

TEST(RefinedPredictor, WhereThereIsNoWayTheRegionStaysAsItIs) {
  std::vector<std::string> rows(10, std::string(80, '.'));
  for (std::string& row : rows) row[40] = '#';
  const OccupancyMap map = test::map_from_rows(rows);
  const GivenRegion all(map.width(), map.height(), std::vector<float>(map.size(), 1.0F));
  const auto inner = std::make_shared<GivenRegion>(all);
  const Prediction prediction = RefinedPredictor(inner, {32, 8}).predict(map, {2.5, 2.5}, {77.5, 2.5});
  EXPECT_FALSE(prediction.region.connected());
}

}  // namespace
}  // namespace lrrt
