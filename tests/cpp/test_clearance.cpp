// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

#include "lrrt/error.hpp"
#include "lrrt/map/clearance_surcharge.hpp"
#include "lrrt/ompl/map_validity.hpp"
#include "lrrt/planner.hpp"
#include "lrrt/predict/grid_predictors.hpp"
#include "support.hpp"

namespace lrrt {
namespace {

using Eigen::Vector2d;

/// Independent of the library's walk: the surcharge along a line, pixel coordinates, by many looks.
double looked_up(const DistanceField& field, const Vector2d& from, const Vector2d& to, const ClearanceCost& clearance) {
  constexpr int looks = 4000;
  double sum = 0.0;
  for (int i = 0; i < looks; ++i) {
    const Vector2d point = from + (i + 0.5) / looks * (to - from);
    const double nearest = field.at(OccupancyMap::pixel_of(point));
    const double lack = std::max(0.0, 1.0 - std::max(0.0, nearest - 1.0) / clearance.distance);
    sum += clearance.weight * lack * lack;
  }
  return sum / looks * (to - from).norm();
}

TEST(Clearance, TheSurchargeIsWhatManyLooksFind) {
  Random random(61);
  for (int i = 0; i < 60; ++i) {
    const OccupancyMap map = test::random_map(random, 5, 60);
    const DistanceField field(map);
    const ClearanceCost clearance{random.uniform(0.5, 12.0), random.uniform(0.1, 9.0)};
    const ClearanceSurcharge surcharge(map, field, clearance);
    for (int k = 0; k < 20; ++k) {
      const Vector2d from(random.uniform(0, map.width()), random.uniform(0, map.height()));
      Vector2d to(random.uniform(0, map.width()), random.uniform(0, map.height()));
      if (k % 5 == 0) to.x() = from.x();
      if (k % 7 == 0) to = from.array().floor().matrix() + Vector2d(3, 3);
      const double cost = surcharge.along(from, to);
      const double length = (to - from).norm();
      EXPECT_NEAR(cost, looked_up(field, from, to, clearance), 2e-3 * clearance.weight * (1.0 + length));
      EXPECT_GE(cost, 0.0);
      EXPECT_LE(cost, clearance.weight * length * (1.0 + 1e-9));
      EXPECT_NEAR(cost, surcharge.along(to, from), 1e-6 * (1.0 + cost));
      const Vector2d middle = from + 0.3 * (to - from);
      EXPECT_NEAR(cost, surcharge.along(from, middle) + surcharge.along(middle, to), 1e-6 * (1.0 + cost));
    }
  }
}

/// Two rooms and two ways between them: a short one, five pixels wide, and a longer one, seventeen pixels wide.
OccupancyMap two_ways() {
  std::vector<std::string> rows(60, std::string(70, '.'));
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const bool narrow = r >= 12 && r < 17;
    const bool wide = r >= 38 && r < 55;
    if (!narrow && !wide) rows[r].replace(20, 30, std::string(30, '#'));
  }
  return test::map_from_rows(rows);
}

PlanOptions options_for(Strategy strategy, std::size_t iterations) {
  PlanOptions options;
  options.strategy = strategy;
  options.stop = Stop::limit;
  options.iteration_limit = iterations;
  options.time_limit = 60.0;
  return options;
}

std::shared_ptr<const RegionPredictor> predictor() {
  return std::make_shared<AStarPredictor>();
}

double length_of(const PlanResult& result) {
  double length = 0.0;
  for (std::size_t i = 1; i < result.path.size(); ++i) length += (result.path[i] - result.path[i - 1]).norm();
  return length;
}

/// Independent of the planner: what a path in the plane costs, map units.
double cost_of(const PlanResult& result, const OccupancyMap& map, const PlanOptions& options) {
  const DistanceField field(map);
  double cost = length_of(result);
  for (std::size_t i = 1; i < result.path.size(); ++i) {
    cost += map.resolution() * looked_up(field, map.to_pixel(result.path[i - 1]), map.to_pixel(result.path[i]),
                                         {options.clearance / map.resolution(), options.clearance_weight});
  }
  return cost;
}

TEST(Clearance, TheWideWayIsTakenWhenItIsAskedFor) {
  const OccupancyMap map = two_ways();
  const PlanRequest request{map, {8.0, 14.5}, {62.0, 14.5}};
  const auto lowest = [&](Strategy strategy, double clearance) {
    PlanOptions options = options_for(strategy, 6000);
    options.clearance = clearance;
    options.clearance_weight = 6.0;
    const PlanResult result = Planner(predictor(), options).plan(request);
    EXPECT_TRUE(result.solved());
    double row = 0.0;
    for (const Vector2d& point : result.path) row = std::max(row, point.y());
    EXPECT_NEAR(result.cost, clearance > 0.0 ? cost_of(result, map, options) : length_of(result), 0.01 * result.cost);
    return row;
  };
  for (const Strategy strategy : {Strategy::uniform, Strategy::frontier}) {
    EXPECT_LT(lowest(strategy, 0.0), 20.0);
    EXPECT_GT(lowest(strategy, 7.0), 38.0);
  }
}

TEST(Clearance, CostsAreConsistentOnRandomMaps) {
  Random random(62);
  int solved = 0;
  for (int i = 0; i < 24; ++i) {
    OccupancyMap map = test::random_map(random, 20, 50);
    if (i % 2 == 0) map = {map.width(), map.height(), map.cells(), 0.05, {-3.0, 7.0, 0.4}};
    if (std::count(map.cells().begin(), map.cells().end(), Cell::free) == 0) continue;
    const PlanRequest request{map, map.to_world(test::random_free_point(map, random)),
                              map.to_world(test::random_free_point(map, random))};
    PlanOptions options = options_for(i % 3 == 0 ? Strategy::uniform : Strategy::frontier, 600);
    constexpr std::array planners{"RRTstar", "RRTConnect", "InformedRRTstar", "RRTsharp"};
    options.planner = planners.at(static_cast<std::size_t>(i) % 4);
    if (i % 4 == 1) options.stop = Stop::first;
    options.simplify = i % 5 == 0;
    options.clearance = random.uniform(0.5, 8.0) * map.resolution();
    const PlanResult result = Planner(predictor(), options).plan(request);
    if (!result.solved()) continue;
    ++solved;
    EXPECT_NEAR(result.cost, cost_of(result, map, options), 5e-3 * result.cost);
    EXPECT_GE(result.cost, length_of(result) * (1.0 - 1e-9));
    for (std::size_t k = 1; k < result.cost_history.size(); ++k) {
      EXPECT_LT(result.cost_history[k].cost, result.cost_history[k - 1].cost);
    }
    EXPECT_NEAR(result.cost_history.back().cost, result.cost, 1e-6 * (1.0 + result.cost));
    options.clearance_weight = 0.0;
    const PlanResult weightless = Planner(predictor(), options).plan(request);
    options.clearance = 0.0;
    const PlanResult plain = Planner(predictor(), options).plan(request);
    EXPECT_EQ(weightless.path, plain.path);
    EXPECT_EQ(weightless.cost, plain.cost);
    EXPECT_NEAR(plain.cost, length_of(plain), 1e-9 * (1.0 + plain.cost));
  }
  EXPECT_GT(solved, 8);
}

/// The cheapest way over a grid three times as fine as the map's, with lines to forty-eight neighbours. Map in pixels.
double grid_optimum(const CollisionMap& map, const ClearanceSurcharge& surcharge, const Vector2d& start,
                    const Vector2d& goal) {
  constexpr int fine = 3;
  const int width = map.map().width() * fine;
  const int height = map.map().height() * fine;
  const auto point = [&](int i) {
    const int row = i / width;
    return Vector2d((i - row * width + 0.5) / fine, (row + 0.5) / fine);
  };
  const auto nearest = [&](const Vector2d& p) {
    return static_cast<int>(p.y() * fine) * width + static_cast<int>(p.x() * fine);
  };
  std::vector<double> costs(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                            std::numeric_limits<double>::infinity());
  using Open = std::pair<double, int>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  costs[static_cast<std::size_t>(nearest(start))] = 0.0;
  open.push({0.0, nearest(start)});
  while (!open.empty()) {
    const auto [cost, at] = open.top();
    open.pop();
    if (at == nearest(goal)) return cost;
    if (cost > costs[static_cast<std::size_t>(at)]) continue;
    for (int dr = -3; dr <= 3; ++dr) {
      for (int dc = -3; dc <= 3; ++dc) {
        const int c = at % width + dc;
        const int r = at / width + dr;
        if (c < 0 || r < 0 || c >= width || r >= height) continue;
        const int to = r * width + c;
        if (!map.is_free(point(at), point(to))) continue;
        const double next = cost + (point(to) - point(at)).norm() + surcharge.along(point(at), point(to));
        if (next >= costs[static_cast<std::size_t>(to)]) continue;
        costs[static_cast<std::size_t>(to)] = next;
        open.push({next, to});
      }
    }
  }
  return std::numeric_limits<double>::infinity();
}

TEST(Clearance, RrtStarComesNearTheOptimum) {
  Random random(63);
  int compared = 0;
  for (int i = 0; i < 4; ++i) {
    const OccupancyMap map = test::random_map(random, 30, 40);
    const PlanRequest request{map, test::random_free_point(map, random), test::random_free_point(map, random)};
    PlanOptions options = options_for(i % 2 == 0 ? Strategy::frontier : Strategy::uniform, 12000);
    options.clearance = 5.0;
    const PlanResult result = Planner(predictor(), options).plan(request);
    if (!result.solved()) continue;
    const CollisionMap collision(map);
    const ClearanceSurcharge surcharge(map, collision.field(), {5.0, options.clearance_weight});
    const double optimum = grid_optimum(collision, surcharge, request.start, request.goal);
    EXPECT_LT(result.cost, 1.05 * optimum + 1.0);
    EXPECT_GT(result.cost, 0.97 * optimum - 1.0);  // lines of a grid are a little longer than need be
    ++compared;
  }
  EXPECT_GE(compared, 2);
}

TEST(Clearance, AFactorOfTheCheapestGridPathIsReached) {
  const OccupancyMap map = two_ways();
  const PlanRequest request{map, {8.0, 14.5}, {62.0, 14.5}};
  PlanOptions options = options_for(Strategy::frontier, 100000);
  options.stop = Stop::factor;
  options.cost_factor = 1.1;
  options.clearance = 7.0;
  const PlanResult result = Planner(predictor(), options).plan(request);
  EXPECT_TRUE(result.solved());
  EXPECT_LT(result.iterations, 100000U);
}

TEST(Clearance, CarsKeepTheirDistanceToo) {
  const OccupancyMap map = two_ways();
  for (const Motion motion : {Motion::turning, Motion::reeds_shepp, Motion::dubins}) {
    PlanRequest request{map, {8.0, 14.5}, {62.0, 14.5}};
    request.motion = motion;
    request.turning_radius = 4.0;
    request.outline = Polygon::rectangle(3.0, 2.0, 1.5);
    PlanOptions options = options_for(Strategy::frontier, 500);
    options.clearance = 4.0;
    const PlanResult result = Planner(predictor(), options).plan(request);
    ASSERT_TRUE(result.solved());
    EXPECT_GT(result.cost, length_of(result));
    for (std::size_t k = 1; k < result.cost_history.size(); ++k) {
      EXPECT_LT(result.cost_history[k].cost, result.cost_history[k - 1].cost);
    }
    EXPECT_NEAR(result.cost_history.back().cost, result.cost, 1e-6 * result.cost);
  }
}

TEST(Clearance, WhatMakesNoSenseIsRefused) {
  const OccupancyMap map = two_ways();
  PlanOptions options;
  options.strategy = Strategy::uniform;
  for (const double bad : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    options.clearance = bad;
    EXPECT_THROW(Planner(nullptr, options), RequestError);
  }
  options.clearance = 1.0;
  options.clearance_weight = -1.0;
  EXPECT_THROW(Planner(nullptr, options), RequestError);
  options.clearance_weight = 1.0;
  options.planner = "SST";
  options.goal_tolerance = 3.0;
  PlanRequest request{map, {8.0, 14.5}, {62.0, 14.5}};
  request.motion = Motion::car;
  request.speed = 1.0;
  request.turning_radius = 3.0;
  EXPECT_THROW(Planner(nullptr, options).plan(request), RequestError);
}

}  // namespace
}  // namespace lrrt
