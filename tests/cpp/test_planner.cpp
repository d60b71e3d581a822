// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <future>
#include <limits>
#include <stdexcept>
#include <thread>

#include "lrrt/error.hpp"
#include "lrrt/map/footprint.hpp"
#include "lrrt/map/shortest_path.hpp"
#include "lrrt/ompl/planners.hpp"
#include "lrrt/planner.hpp"
#include "support.hpp"

namespace lrrt {
namespace {

/// Marks a corridor around the shortest grid path, or whatever a test wants.
class FixedPredictor final : public RegionPredictor {
 public:
  enum class Kind { corridor, empty, full, far_from_it };
  explicit FixedPredictor(Kind kind, int detail = std::numeric_limits<int>::max()) : kind_(kind), detail_(detail) {}

  Prediction predict(const OccupancyMap& map, const Eigen::Vector2d& start,
                     const Eigen::Vector2d& goal) const override {
    const Pixel from = OccupancyMap::pixel_of(map.to_pixel(start));
    const Pixel to = OccupancyMap::pixel_of(map.to_pixel(goal));
    std::vector<float> probability(map.size(), kind_ == Kind::full || kind_ == Kind::far_from_it ? 1.0F : 0.0F);
    const float mark = kind_ == Kind::corridor ? 1.0F : 0.0F;
    if (kind_ == Kind::corridor || kind_ == Kind::far_from_it) {
      for (const Pixel p : shortest_path(map, from, to)) {
        for (int k = 0; k < 9; ++k) {
          const Pixel q{p.c + k % 3 - 1, p.r + k / 3 - 1};
          if (map.contains(q)) probability[map.index(q)] = mark;
        }
      }
    }
    return {PromisingRegion(map, std::move(probability), from, to), {}};
  }

  int detail() const override { return detail_; }

 private:
  Kind kind_;
  int detail_;
};

/// Fails in one of the ways in which a predictor can.
class FailingPredictor final : public RegionPredictor {
 public:
  enum class How { model_error, other_exception, wrong_size, request_error };
  explicit FailingPredictor(How how) : how_(how) {}

  Prediction predict(const OccupancyMap&, const Eigen::Vector2d&, const Eigen::Vector2d&) const override {
    if (how_ == How::model_error) throw ModelError("the model is broken");
    if (how_ == How::other_exception) throw std::runtime_error("the predictor is broken");
    if (how_ == How::request_error) throw RequestError("the request is broken");
    return {PromisingRegion(test::map_from_rows({".."}), {1.0F, 1.0F}, {0, 0}, {1, 0}), {}};
  }

 private:
  How how_;
};

std::shared_ptr<const RegionPredictor> corridor() {
  return std::make_shared<FixedPredictor>(FixedPredictor::Kind::corridor);
}

PlanOptions unguided(const std::string& planner = "RRTstar") {
  PlanOptions options;
  options.planner = planner;
  options.strategy = Strategy::uniform;
  return options;
}

double length(const std::vector<Eigen::Vector2d>& path) {
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += (path[i] - path[i - 1]).norm();
  return sum;
}

/// All that must hold of any result, checked by code that shares nothing with the planner.
void expect_honest(const PlanResult& result, const OccupancyMap& planning_map, const Eigen::Vector2d& start,
                   const Eigen::Vector2d& goal) {
  const Pixel start_pixel = OccupancyMap::pixel_of(planning_map.to_pixel(start));
  const Pixel goal_pixel = OccupancyMap::pixel_of(planning_map.to_pixel(goal));
  if (result.status == PlanStatus::not_connected) {
    EXPECT_EQ(test::flood(planning_map, start_pixel)[planning_map.index(goal_pixel)], 0);
  }
  if (!result.solved()) {
    EXPECT_TRUE(result.path.empty());
    EXPECT_TRUE(std::isinf(result.cost));
    return;
  }
  ASSERT_GE(result.path.size(), 1U);
  EXPECT_LT((result.path.front() - start).norm(), 1e-9);
  EXPECT_LT((result.path.back() - goal).norm(), 1e-9);
  EXPECT_NEAR(result.cost, length(result.path), 1e-9);
  for (std::size_t i = 1; i < result.path.size(); ++i) {
    EXPECT_FALSE(test::crosses_blocked(planning_map, planning_map.to_pixel(result.path[i - 1]),
                                       planning_map.to_pixel(result.path[i])));
  }
  for (std::size_t i = 1; i < result.cost_history.size(); ++i) {
    EXPECT_LT(result.cost_history[i].cost, result.cost_history[i - 1].cost);
  }
  ASSERT_FALSE(result.cost_history.empty());
  EXPECT_NEAR(result.cost_history.back().cost, result.cost, 1e-6);
}

/// The three planners that the library vouches for; of OMPL's others it only promises that what they return is true.
bool vouched_for(const std::string& planner) {
  return planner == "RRT" || planner == "RRTConnect" || planner == "RRTstar";
}

/// Planners of OMPL 1.5 that give up on some of the small maps here, guided or not; and those that grow by the clock,
/// so that a busy machine has them solve less.
bool moody(const std::string& planner) {
  return planner == "PRM" || planner == "PRMstar" || planner == "AITstar" || planner == "TRRT" || planner == "SST" ||
         planner == "EST" || planner == "BiEST";
}

class EveryPlanner : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryPlanner, IsHonestOnRandomMapsWithRandomRegions) {
  Random random(51);
  int solved = 0;
  int disconnected = 0;
  const int maps = vouched_for(GetParam()) ? 120 : 24;
  for (int i = 0; i < maps; ++i) {
    const OccupancyMap map = test::random_map(random, 3, 60);
    const Eigen::Vector2d start = test::random_free_point(map, random);
    const Eigen::Vector2d goal = test::random_free_point(map, random);
    const double radius = i % 3 == 0 ? random.uniform(0.0, 2.0) : 0.0;
    PlanOptions options = unguided(GetParam());
    options.strategy = std::array{Strategy::region, Strategy::uniform, Strategy::frontier}[i % 3];
    options.stop = i % 5 == 0 && GetParam() == "RRTstar" ? Stop::factor : Stop::first;
    options.cost_factor = 1.3;
    options.iteration_limit = vouched_for(GetParam()) ? 30000 : 3000;
    options.seed = static_cast<std::uint64_t>(i);
    const auto kind = static_cast<FixedPredictor::Kind>(i / 2 % 4);
    const int detail = i % 4 == 3 ? 20 : 60;  // pixels a side: with fewer than the map has, guidance is coarser than it
    const auto predictor = std::make_shared<FixedPredictor>(kind, detail);
    const PlanResult result = Planner(predictor, options).plan({map, start, goal, radius});
    expect_honest(result, inflated(map, radius), start, goal);
    solved += static_cast<int>(result.solved());
    disconnected += static_cast<int>(result.status == PlanStatus::not_connected);
    if (radius == 0.0 && vouched_for(GetParam())) {
      EXPECT_TRUE(result.solved() || result.status == PlanStatus::not_connected) << to_string(result.status);
    }
  }
  EXPECT_GE(solved, moody(GetParam()) ? 1 : maps / 2);
  EXPECT_GT(disconnected, 0);
}

TEST_P(EveryPlanner, TheSameSeedGivesTheSameResult) {
  if (GetParam() == "PRM" || GetParam() == "PRMstar")
    GTEST_SKIP() << "PRM grows by the clock and looks from a second thread";
  Random random(52);
  int different = 0;
  for (int i = 0; i < 6; ++i) {
    const OccupancyMap map = test::random_map(random, 30, 60);
    const Eigen::Vector2d start = test::random_free_point(map, random);
    const Eigen::Vector2d goal = test::random_free_point(map, random);
    PlanOptions options = unguided(GetParam());
    options.strategy = i % 2 == 0 ? Strategy::region : Strategy::frontier;
    options.iteration_limit = vouched_for(GetParam()) || GetParam() == "FMT" ? 2000 : 500;
    options.stop = GetParam() == "RRTstar" ? Stop::limit : Stop::first;
    options.time_limit = 60.0;
    options.keep_tree = true;
    const PlanResult first = Planner(corridor(), options).plan({map, start, goal});
    const PlanResult second = Planner(corridor(), options).plan({map, start, goal});
    options.seed = 2;
    const PlanResult other = Planner(corridor(), options).plan({map, start, goal});
    EXPECT_EQ(first.status, second.status);
    EXPECT_EQ(first.path, second.path);
    EXPECT_EQ(first.nodes, second.nodes);
    EXPECT_TRUE(std::equal(first.tree.begin(), first.tree.end(), second.tree.begin(), second.tree.end(),
                           [](const TreeEdge& a, const TreeEdge& b) { return a.from == b.from && a.to == b.to; }));
    EXPECT_EQ(first.iterations, second.iterations);
    different += static_cast<int>(first.path != other.path);
  }
  EXPECT_GT(different, 0);
}

TEST(Planner, TheGridOfNeighboursChangesNothingButTheTime) {
  Random random(57);
  for (const char* name : {"RRT", "RRTConnect", "RRTstar", "InformedRRTstar", "RRTsharp", "RRTXstatic"}) {
    for (int i = 0; i < 9; ++i) {
      const OccupancyMap map = test::random_map(random, 20, 60);
      PlanOptions options = unguided(name);
      options.iteration_limit = 1500;
      options.range = std::array{0.0, 5.0, 10.0}[static_cast<std::size_t>(i % 3)];  // nodes at exactly the range
      options.stop = std::string(name) == "RRT" || std::string(name) == "RRTConnect" ? Stop::first : Stop::limit;
      const PlanRequest request{map, test::random_free_point(map, random), test::random_free_point(map, random)};
      const PlanResult ours = Planner(nullptr, options).plan(request);
      options.neighbors = Neighbors::ompl;
      const PlanResult theirs = Planner(nullptr, options).plan(request);
      EXPECT_EQ(ours.status, theirs.status) << name;
      EXPECT_EQ(ours.iterations, theirs.iterations) << name;
      EXPECT_EQ(ours.nodes, theirs.nodes) << name;
      EXPECT_EQ(ours.motion_checks, theirs.motion_checks) << name;
      EXPECT_EQ(ours.path, theirs.path) << name;
    }
  }
}

TEST_P(EveryPlanner, PlansInMetresWithAnOriginAndAYaw) {
  Random random(53);
  int solved = 0;
  for (int i = 0; i < 20; ++i) {
    const OccupancyMap pixels = test::random_map(random, 10, 50);
    const OccupancyMap map(pixels.width(), pixels.height(), pixels.cells(), 0.05, {-3.0, 7.0, random.uniform(-3, 3)});
    const Eigen::Vector2d start = map.to_world(test::random_free_point(pixels, random));
    const Eigen::Vector2d goal = map.to_world(test::random_free_point(pixels, random));
    PlanOptions options = unguided(GetParam());
    options.strategy = i % 2 == 0 ? Strategy::region : Strategy::frontier;
    if (!vouched_for(GetParam())) options.iteration_limit = 2000;
    const PlanResult result = Planner(corridor(), options).plan({map, start, goal});
    expect_honest(result, map, start, goal);
    solved += static_cast<int>(result.solved());
  }
  if (!moody(GetParam())) {
    EXPECT_GT(solved, 8);
  }
}

INSTANTIATE_TEST_SUITE_P(Planner, EveryPlanner, ::testing::ValuesIn(planner_names()));

TEST(Planner, SaysWhatIsWrongBeforeItPlans) {
  const OccupancyMap map = test::map_from_rows({"..#..", "..#..", "?.#.."});
  const Planner planner(nullptr, unguided());
  const auto status = [&](Eigen::Vector2d start, Eigen::Vector2d goal) {
    return planner.plan({map, start, goal}).status;
  };
  EXPECT_EQ(status({-0.1, 0.5}, {0.5, 0.5}), PlanStatus::start_outside);
  EXPECT_EQ(status({0.5, 0.5}, {0.5, 3.0}), PlanStatus::goal_outside);
  EXPECT_EQ(status({2.5, 0.5}, {0.5, 0.5}), PlanStatus::start_occupied);
  EXPECT_EQ(status({0.5, 0.5}, {2.5, 2.5}), PlanStatus::goal_occupied);
  EXPECT_EQ(status({0.5, 2.5}, {0.5, 0.5}), PlanStatus::start_occupied);  // unknown counts as occupied
  EXPECT_EQ(status({0.5, 0.5}, {4.5, 0.5}), PlanStatus::not_connected);
  EXPECT_EQ(planner.plan({map, {0.5, 2.5}, {0.5, 0.5}, 0.0, UnknownIs::free}).status, PlanStatus::solved);
  EXPECT_EQ(planner.plan({map, {0.5, 0.5}, {1.5, 2.5}, 5.0}).status, PlanStatus::start_occupied);
}

TEST(Planner, StartAndGoalMayCoincide) {
  const OccupancyMap map = test::map_from_rows({"...", "..."});
  for (const std::string& name : planner_names()) {
    const PlanResult result = Planner(nullptr, unguided(name)).plan({map, {1.2, 0.7}, {1.2, 0.7}});
    EXPECT_EQ(result.status, PlanStatus::solved) << name;
    EXPECT_EQ(result.cost, 0.0) << name;
  }
}

TEST(Planner, DrawsItsShareFromTheRegion) {
  const OccupancyMap map = test::map_from_rows(std::vector<std::string>(60, std::string(60, '.')));
  PlanOptions options = unguided();
  options.strategy = Strategy::region;
  options.alpha = 0.8;
  options.stop = Stop::limit;
  options.iteration_limit = 5000;
  const DrawCounts draws = Planner(corridor(), options).plan({map, {5, 5}, {50, 50}}).draws;
  const auto total = static_cast<double>(draws.guided + draws.uniform);
  EXPECT_GT(total, 4000);
  EXPECT_NEAR(static_cast<double>(draws.guided) / total, 0.8, 0.03);
  options.alpha = 0.0;
  EXPECT_EQ(Planner(corridor(), options).plan({map, {5, 5}, {50, 50}}).draws.guided, 0U);
}

TEST(Planner, BridgesARegionThatDoesNotJoinStartAndGoal) {
  const OccupancyMap map = test::map_from_rows(std::vector<std::string>(60, std::string(60, '.')));
  PlanOptions options = unguided();
  options.strategy = Strategy::region;
  const auto empty = std::make_shared<FixedPredictor>(FixedPredictor::Kind::empty);
  const PlanResult result = Planner(empty, options).plan({map, {5, 5}, {50, 50}});
  ASSERT_TRUE(result.region != nullptr);
  EXPECT_TRUE(result.region->connected());
  EXPECT_GT(result.region->bridge_area(), 0U);
  EXPECT_EQ(result.region->bridge_area(), result.region->area());
}

TEST(Planner, LimitsEndTheSearch) {
  const OccupancyMap map = test::map_from_rows(std::vector<std::string>(60, std::string(60, '.')));
  PlanOptions options = unguided();
  options.stop = Stop::limit;
  options.iteration_limit = 100;
  const PlanResult counted = Planner(nullptr, options).plan({map, {1, 1}, {59, 59}});
  EXPECT_EQ(counted.iterations, 100U);
  options.iteration_limit = std::numeric_limits<std::size_t>::max();
  options.time_limit = 0.05;
  const PlanResult timed = Planner(nullptr, options).plan({map, {1, 1}, {59, 59}});
  EXPECT_EQ(timed.status, PlanStatus::solved);
  EXPECT_GE(timed.timings.plan, 50.0);
  PlanRequest request{map, {1, 1}, {59, 59}};
  request.cancel.cancel();
  EXPECT_EQ(Planner(nullptr, options).plan(request).status, PlanStatus::cancelled);
}

TEST(Planner, TimeAlsoEndsAnIterationOfManyMotions) {
  // RRT-Connect extends until it is blocked, within one iteration: here by many millions of motions.
  const OccupancyMap map = test::map_from_rows(std::vector<std::string>(40, std::string(50, '.')));
  PlanOptions options = unguided("RRTConnect");
  options.range = 1e-3;
  options.time_limit = 0.1;
  const PlanResult result = Planner(nullptr, options).plan({map, {1, 1}, {49, 39}});
  EXPECT_EQ(result.status, PlanStatus::time_limit);
  EXPECT_LT(result.timings.plan, 2000.0);
  options.range = 1e-17;
  EXPECT_THROW(Planner(nullptr, options).plan({map, {1, 1}, {49, 39}}), RequestError);
}

TEST(Planner, GuidanceIsAsCoarseAsItCanBe) {
  std::vector<std::string> rows(64, std::string(64, '.'));
  for (std::size_t r = 0; r < 64; ++r) rows[r][31] = r == 40 || r == 41 ? '.' : '#';  // a gap of two pixels
  const OccupancyMap map = test::map_from_rows(rows);
  PlanOptions options = unguided("RRTConnect");
  options.strategy = Strategy::frontier;
  const auto coarseness = [&](int detail, const Eigen::Vector2d& goal) {
    const auto predictor = std::make_shared<FixedPredictor>(FixedPredictor::Kind::corridor, detail);
    const PlanResult result = Planner(predictor, options).plan({map, {4.5, 4.5}, goal});
    expect_honest(result, map, {4.5, 4.5}, goal);
    return result.region->coarseness();
  };
  EXPECT_EQ(coarseness(64, {12.5, 60.5}), 1);
  EXPECT_EQ(coarseness(63, {12.5, 60.5}), 2);
  EXPECT_EQ(coarseness(8, {12.5, 60.5}), 8);
  EXPECT_EQ(coarseness(8, {60.5, 60.5}), 2);  // in larger pixels the gap is closed
  EXPECT_EQ(coarseness(8, {30.5, 60.5}), 1);  // the goal stands at the wall
}

TEST(Planner, TheStraightLineEndsTheSearch) {
  const OccupancyMap map = test::map_from_rows(std::vector<std::string>(20, std::string(20, '.')));
  for (const std::string& name : planner_names()) {
    if (!shortens_its_path(name) || name == "SST") continue;  // SST takes steps of random length
    for (const Motion motion : {Motion::plane, Motion::turning}) {
      PlanOptions options = unguided(name);
      options.stop = Stop::limit;
      options.time_limit = 60.0;
      PlanRequest request{map, {5.2, 5.1}, {5.9, 5.3}};
      request.motion = motion;
      const PlanResult result = Planner(nullptr, options).plan(request);
      EXPECT_NEAR(result.cost, std::hypot(0.7, 0.2), 1e-9) << name;
      EXPECT_LT(result.timings.plan, 30e3) << name;
    }
  }
}

TEST(Planner, AGoalToleranceThatWouldEndTheProcessIsRefused) {
  PlanOptions options = unguided("AITstar");
  options.goal_tolerance = 1.0;
  EXPECT_THROW(Planner(nullptr, options), RequestError);
}

TEST(Planner, APredictorThatReturnsAnotherSizeIsRefused) {
  class Wrong final : public RegionPredictor {
   public:
    Prediction predict(const OccupancyMap&, const Eigen::Vector2d&, const Eigen::Vector2d&) const override {
      const OccupancyMap other = test::map_from_rows({"..", ".."});
      return {PromisingRegion(other, std::vector<float>(4, 0.0F), {0, 0}, {1, 1}), {}};
    }
  };
  const OccupancyMap map = test::map_from_rows(std::vector<std::string>(40, std::string(50, '.')));
  PlanOptions options = unguided();
  options.strategy = Strategy::region;
  EXPECT_THROW(Planner(std::make_shared<Wrong>(), options).plan({map, {1, 1}, {49, 39}}), ModelError);
}

TEST(Planner, AnotherThreadCanCancel) {
  std::vector<std::string> rows(60, std::string(60, '.'));
  rows[30].replace(5, 50, 50, '#');  // a straight line would end the search
  const OccupancyMap map = test::map_from_rows(rows);
  PlanOptions options = unguided();
  options.stop = Stop::limit;
  options.time_limit = 60.0;
  PlanRequest request{map, {1, 1}, {59, 59}};
  const Planner planner(nullptr, options);
  auto future = std::async(std::launch::async, [&] { return planner.plan(request); });
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  request.cancel.cancel();
  EXPECT_EQ(future.wait_for(std::chrono::seconds(5)), std::future_status::ready);
  EXPECT_TRUE(future.get().solved());  // it had found a path before it was asked to stop shortening it
}

TEST(Planner, WhatIsCancelledIsNotPredicted) {
  class Asked final : public RegionPredictor {
   public:
    Prediction predict(const OccupancyMap& map, const Eigen::Vector2d&, const Eigen::Vector2d&) const override {
      ADD_FAILURE() << "asked for a region of a map of " << map.width() << " columns";
      throw ModelError("");
    }
  };
  const OccupancyMap map = test::map_from_rows(std::vector<std::string>(60, std::string(60, '.')));
  PlanRequest request{map, {1, 1}, {59, 59}};
  request.cancel.cancel();
  const PlanResult result = Planner(std::make_shared<Asked>(), {}).plan(request);
  EXPECT_EQ(result.status, PlanStatus::cancelled);
  EXPECT_EQ(result.timings.plan, 0.0);
}

TEST(Planner, TheTreeHoldsThePath) {
  Random random(54);
  const OccupancyMap map = test::map_from_rows(std::vector<std::string>(40, std::string(40, '.')));
  PlanOptions options = unguided();
  options.keep_tree = true;
  const PlanResult result = Planner(nullptr, options).plan({map, {1, 1}, {39, 39}});
  ASSERT_TRUE(result.solved());
  EXPECT_EQ(result.tree.size() + 1, result.nodes);
  for (std::size_t i = 1; i < result.path.size(); ++i) {
    const bool found = std::any_of(result.tree.begin(), result.tree.end(), [&](const TreeEdge& edge) {
      return edge.from == result.path[i - 1] && edge.to == result.path[i];
    });
    EXPECT_TRUE(found) << i;
  }
}

TEST(Planner, MoreTimeNeverMakesThePathLonger) {
  const OccupancyMap map = test::map_from_rows(std::vector<std::string>(60, std::string(60, '.')));
  PlanOptions options = unguided();
  const double first = Planner(nullptr, options).plan({map, {1, 1}, {59, 59}}).cost;
  options.stop = Stop::limit;
  options.iteration_limit = 5000;
  const PlanResult longer = Planner(nullptr, options).plan({map, {1, 1}, {59, 59}});
  EXPECT_LT(longer.cost, first);
  EXPECT_GE(longer.cost, std::sqrt(2.0) * 58.0 - 1e-9);
  options.stop = Stop::factor;
  options.cost_factor = 1.1;
  EXPECT_LE(Planner(nullptr, options).plan({map, {1, 1}, {59, 59}}).cost, 1.1 * std::sqrt(2.0) * 58.0 + 1e-6);
}

TEST(Planner, APredictionThatFailsIsRaisedOrDoneWithout) {
  using How = FailingPredictor::How;
  Random random(31);
  for (const auto& [how, text] :
       {std::pair{How::model_error, "the model is broken"}, std::pair{How::other_exception, "the predictor is broken"},
        std::pair{How::wrong_size, "2×1"}}) {
    const auto predictor = std::make_shared<FailingPredictor>(how);
    const OccupancyMap map = test::random_map(random, 20, 40);
    const Eigen::Vector2d start = test::random_free_point(map, random);
    PlanOptions options;
    options.stop = Stop::limit;
    options.iteration_limit = 300;
    options.strategy = Strategy::uniform;
    const PlanResult expected = Planner(nullptr, options).plan({map, start, start + Eigen::Vector2d(1e-3, 0.0)});
    options.strategy = Strategy::frontier;
    const PlanRequest request{map, start, start + Eigen::Vector2d(1e-3, 0.0)};
    EXPECT_ANY_THROW(Planner(predictor, options).plan(request));
    options.on_predict_error = OnPredictError::unguided;
    const PlanResult result = Planner(predictor, options).plan(request);
    EXPECT_NE(result.predict_error.find(text), std::string::npos) << result.predict_error;
    EXPECT_EQ(result.region, nullptr);
    EXPECT_EQ(result.status, expected.status);
    EXPECT_EQ(result.path, expected.path);
    EXPECT_EQ(result.nodes, expected.nodes);
    EXPECT_EQ(result.draws.guided, 0U);
  }
}

TEST(Planner, ABrokenRequestIsRaisedWhateverBecomesOfPredictions) {
  const OccupancyMap map = test::map_from_rows({"...", "..."});
  PlanOptions options;
  options.on_predict_error = OnPredictError::unguided;
  const Planner planner(std::make_shared<FailingPredictor>(FailingPredictor::How::request_error), options);
  EXPECT_THROW(planner.plan({map, {0.5, 0.5}, {2.5, 1.5}}), RequestError);
  EXPECT_THROW(Planner(corridor(), options).plan({map, {std::nan(""), 0.5}, {2.5, 1.5}}), RequestError);
  const PlanResult fine = Planner(corridor(), options).plan({map, {0.5, 0.5}, {2.5, 1.5}});
  EXPECT_TRUE(fine.solved());
  EXPECT_NE(fine.region, nullptr);
  EXPECT_EQ(fine.predict_error, "");
  EXPECT_THROW(on_predict_error_from_string("ignore"), RequestError);
}

TEST(Planner, OptionsAndRequestsAreChecked) {
  const auto refused = [](auto change) {
    PlanOptions options = unguided();
    change(options);
    EXPECT_THROW(Planner(nullptr, options), RequestError);
  };
  refused([](PlanOptions& o) { o.alpha = 1.1; });
  refused([](PlanOptions& o) { o.alpha = std::nan(""); });
  refused([](PlanOptions& o) { o.range = -1.0; });
  refused([](PlanOptions& o) { o.range = std::numeric_limits<double>::infinity(); });
  refused([](PlanOptions& o) { o.goal_bias = 2.0; });
  refused([](PlanOptions& o) { o.time_limit = 0.0; });
  refused([](PlanOptions& o) { o.time_limit = std::nan(""); });
  refused([](PlanOptions& o) { o.cost_factor = 0.9; });
  refused([](PlanOptions& o) { o.goal_tolerance = -0.1; });
  refused([](PlanOptions& o) { o.planner = "A star"; });
  refused([](PlanOptions& o) { o.goal_bias = 0.0; });
  refused([](PlanOptions& o) {
    o.planner = "RRTConnect";
    o.stop = Stop::limit;
  });
  refused([](PlanOptions& o) { o.strategy = Strategy::region; });  // and no predictor
  const OccupancyMap map = test::map_from_rows({".."});
  EXPECT_THROW(Planner(nullptr, unguided()).plan({map, {std::nan(""), 0.5}, {1.5, 0.5}}), RequestError);
  EXPECT_THROW(strategy_from_string("frontal"), RequestError);
  EXPECT_THROW(stop_from_string("never"), RequestError);
}

}  // namespace
}  // namespace lrrt
