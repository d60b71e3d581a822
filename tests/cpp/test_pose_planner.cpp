// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lrrt/error.hpp"
#include "lrrt/map/footprint.hpp"
#include "lrrt/ompl/planners.hpp"
#include "lrrt/ompl/pose_validity.hpp"
#include "lrrt/planner.hpp"
#include "lrrt/predict/grid_predictors.hpp"
#include "pose_support.hpp"
#include "support.hpp"

namespace lrrt {
namespace {

namespace ob = ompl::base;

using test::angle_between;
using test::overlaps_blocked;
using test::random_pose;
using test::random_room;

constexpr double pi = 3.141592653589793;

/// A map of blocks in metres with an origin and a yaw, or in pixels, and two poses on it at which the robot fits.
struct Query {
  OccupancyMap map;
  Pose2 start;
  Pose2 goal;
};

PlanRequest request_of(const Query& query, const Polygon& robot, Motion motion, double turning_radius) {
  PlanRequest request{query.map, {query.start.x, query.start.y}, {query.goal.x, query.goal.y}};
  request.outline = robot;
  request.motion = motion;
  request.turning_radius = turning_radius;
  request.start_heading = query.start.yaw;
  request.goal_heading = query.goal.yaw;
  return request;
}

PlanOptions options_for(const std::string& planner, Strategy strategy) {
  PlanOptions options;
  options.planner = planner;
  options.strategy = strategy;
  options.iteration_limit = 1500;
  options.time_limit = 20.0;
  return options;
}

std::shared_ptr<const RegionPredictor> predictor() {
  return std::make_shared<AStarPredictor>();
}

/// How a path has to look where the robot drives like a car: every step is one arc no tighter than it can, or a
/// straight line, driven along the heading. @return the length of the arcs and lines.
double expect_drivable(const PlanResult& result, const PlanRequest& request, double pixel) {
  double length = 0.0;
  for (std::size_t i = 1; i < result.path.size(); ++i) {
    const Eigen::Vector2d move = result.path[i] - result.path[i - 1];
    const double turn = std::remainder(result.headings[i] - result.headings[i - 1], 2.0 * pi);
    const double middle = result.headings[i - 1] + 0.5 * turn;
    const Eigen::Vector2d ahead(std::cos(middle), std::sin(middle));
    const double slack = 1e-4 * pixel;  // of curves that miss their ends by a hair
    EXPECT_LT(std::abs(ahead.x() * move.y() - ahead.y() * move.x()), slack) << "sideways at " << i;
    if (request.motion == Motion::dubins) {
      EXPECT_GT(ahead.dot(move), -slack) << "backwards at " << i;
    }
    const double half = 0.5 * std::abs(turn);
    const double arc = half > 0.0 ? move.norm() * half / std::sin(half) : move.norm();
    EXPECT_LE(std::abs(turn) * request.turning_radius, arc + slack) << "too tight at " << i;
    length += arc;
  }
  return length;
}

/// All that must hold of any result, checked by code that shares nothing with the planner.
void expect_honest(const PlanResult& result, const PlanRequest& request) {
  const OccupancyMap& map = request.map.get();
  const std::vector<Eigen::Vector2d>& outline = request.outline->vertices();
  const bool start_fits = !test::overlaps_blocked(map, outline, request.start, request.start_heading);
  const bool goal_fits = !test::overlaps_blocked(map, outline, request.goal, request.goal_heading);
  if (result.status == PlanStatus::start_occupied) {
    EXPECT_FALSE(start_fits);
  }
  if (result.status == PlanStatus::goal_occupied) {
    EXPECT_FALSE(goal_fits);
  }
  if (!result.solved()) {
    EXPECT_TRUE(result.path.empty());
    EXPECT_TRUE(result.headings.empty());
    EXPECT_TRUE(std::isinf(result.cost));
    return;
  }
  EXPECT_TRUE(start_fits && goal_fits);
  ASSERT_GE(result.path.size(), 2U);
  ASSERT_EQ(result.headings.size(), result.path.size());
  EXPECT_EQ(result.path.front(), request.start);
  EXPECT_EQ(result.path.back(), request.goal);
  EXPECT_EQ(result.headings.front(), request.start_heading);
  EXPECT_EQ(result.headings.back(), request.goal_heading);
  const double reach = request.outline->circumscribed_radius();
  double length = 0.0;
  double turned = 0.0;
  for (std::size_t i = 0; i < result.path.size(); ++i) {
    EXPECT_FALSE(test::overlaps_blocked(map, outline, result.path[i], result.headings[i])) << i;
    if (i == 0) continue;
    const double move = (result.path[i] - result.path[i - 1]).norm();
    const double turn = angle_between(result.headings[i], result.headings[i - 1]);
    EXPECT_LE(move + reach * turn, map.resolution() * (1.0 + 1e-6) + 1e-6);
    length += move;
    turned += turn;
  }
  if (request.motion == Motion::turning) {
    EXPECT_NEAR(result.cost, length + reach * turned, 1e-6 * (1.0 + result.cost));
  } else {
    EXPECT_NEAR(result.cost, expect_drivable(result, request, map.resolution()), 1e-3 * map.resolution());
  }
  ASSERT_FALSE(result.cost_history.empty());
  EXPECT_NEAR(result.cost_history.back().cost, result.cost, 1e-6 * (1.0 + result.cost));
}

using Case = std::tuple<std::string, Motion>;

std::string word(Motion motion) {
  return motion == Motion::turning ? "turning" : motion == Motion::dubins ? "dubins" : "reeds_shepp";
}

class PosePlanner : public ::testing::TestWithParam<Case> {};

TEST_P(PosePlanner, IsHonestOnRandomMaps) {
  const auto& [name, motion] = GetParam();
  if (motion == Motion::dubins && !keeps_direction(name)) GTEST_SKIP() << "refused, see below";
  Random random(71);
  const bool main_planner = name == "RRT" || name == "RRTConnect" || name == "RRTstar";
  const int maps = main_planner ? 24 : 6;
  int solved = 0;
  for (int i = 0; i < maps; ++i) {
    const OccupancyMap map = random_room(random, i % 2 == 0);
    const double unit = map.resolution();
    const Polygon robot = Polygon::rectangle(unit * random.uniform(2.0, 7.0), unit * random.uniform(1.0, 4.0), unit);
    const Query query{map, random_pose(map, robot, random), random_pose(map, robot, random)};
    const PlanRequest request = request_of(query, robot, motion, unit * random.uniform(1.0, 6.0));
    PlanOptions options = options_for(
        name, std::array{Strategy::uniform, Strategy::frontier, Strategy::region}.at(static_cast<std::size_t>(i) % 3));
    options.iteration_limit = main_planner ? 1000 : 200;
    options.simplify = i % 4 == 3;
    options.seed = static_cast<std::uint64_t>(i);
    const PlanResult result = Planner(predictor(), options).plan(request);
    expect_honest(result, request);
    solved += static_cast<int>(result.solved());
  }
  if (main_planner) {
    EXPECT_GE(solved, maps / 2);
  }
}

TEST_P(PosePlanner, TheSameSeedGivesTheSameResult) {
  const auto& [name, motion] = GetParam();
  if (motion == Motion::dubins && !keeps_direction(name)) GTEST_SKIP() << "refused, see below";
  if (name == "PRM" || name == "PRMstar") GTEST_SKIP() << "PRM grows by the clock and looks from a second thread";
  Random random(72);
  const Polygon robot = Polygon::rectangle(4.0, 2.0, 1.0);
  for (int i = 0; i < 3; ++i) {
    const OccupancyMap map = random_room(random, false);
    const Query query{map, random_pose(map, robot, random), random_pose(map, robot, random)};
    PlanOptions options = options_for(name, i % 2 == 0 ? Strategy::frontier : Strategy::uniform);
    options.iteration_limit = 150;
    options.simplify = i == 1;
    const PlanRequest request = request_of(query, robot, motion, 3.0);
    const PlanResult first = Planner(predictor(), options).plan(request);
    const PlanResult second = Planner(predictor(), options).plan(request);
    EXPECT_EQ(first.status, second.status);
    EXPECT_EQ(first.iterations, second.iterations);
    EXPECT_EQ(first.nodes, second.nodes);
    EXPECT_EQ(first.path, second.path);
    EXPECT_EQ(first.headings, second.headings);
  }
}

INSTANTIATE_TEST_SUITE_P(Spaces, PosePlanner,
                         ::testing::Combine(::testing::ValuesIn(planner_names()),
                                            ::testing::Values(Motion::turning, Motion::dubins, Motion::reeds_shepp)),
                         [](const auto& info) {
                           return std::get<0>(info.param) + "_" + word(std::get<1>(info.param));
                         });

/// Two rooms joined by a corridor along row 20, seven pixels wide.
OccupancyMap two_rooms() {
  std::vector<std::string> rows(40, std::string(60, '.'));
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (r < 17 || r >= 24) rows[r].replace(22, 16, 16, '#');
  }
  return test::map_from_rows(rows);
}

TEST(PosePlannerCheck, APolygonPassesWhereItsDiscDoesNot) {
  const OccupancyMap map = two_rooms();
  PlanRequest request{map, {8.0, 20.5}, {52.0, 20.5}};
  request.motion = Motion::reeds_shepp;
  request.turning_radius = 6.0;
  const PlanOptions options = options_for("RRTConnect", Strategy::frontier);
  request.outline = Polygon::rectangle(12.0, 4.0, 6.0);
  EXPECT_EQ(Planner(predictor(), options).plan(request).status, PlanStatus::solved);
  request.outline.reset();
  request.radius = 6.0;
  EXPECT_EQ(Planner(predictor(), options).plan(request).status, PlanStatus::not_connected);
  request.radius = 2.0;
  EXPECT_EQ(Planner(predictor(), options).plan(request).status, PlanStatus::solved);
}

TEST(PosePlannerCheck, StatusesAreTrue) {
  const OccupancyMap map = two_rooms();
  const PlanOptions options = options_for("RRTConnect", Strategy::frontier);
  const auto status = [&](const Pose2& start, const Pose2& goal, const Polygon& robot) {
    const Query query{map, start, goal};
    return Planner(predictor(), options).plan(request_of(query, robot, Motion::turning, 0.0)).status;
  };
  const Polygon thin = Polygon::rectangle(12.0, 4.0, 6.0);
  EXPECT_EQ(status({-1, 20, 0}, {52, 20, 0}, thin), PlanStatus::start_outside);
  EXPECT_EQ(status({8, 20, 0}, {52, 40.5, 0}, thin), PlanStatus::goal_outside);
  EXPECT_EQ(status({3, 20, 0}, {52, 20, 0}, thin), PlanStatus::start_occupied);
  EXPECT_EQ(status({3, 20, pi / 2}, {30, 20.5, pi / 2}, thin), PlanStatus::goal_occupied);
  EXPECT_EQ(status({3, 20, pi / 2}, {30, 20.5, pi}, thin), PlanStatus::solved);
  EXPECT_EQ(status({8, 20, 0}, {52, 20, 0}, Polygon::rectangle(12.0, 8.5, 6.0)), PlanStatus::not_connected);
  // by a tenth of a pixel: nothing is proven, nothing is found
  EXPECT_NE(status({8, 20, 0}, {52, 20, 0}, Polygon::rectangle(12.0, 7.1, 6.0)), PlanStatus::solved);
}

TEST(PosePlannerCheck, NotConnectedIsNeverSaidOfAPathThatExists) {
  // A corridor that the robot fits by a hundredth of a pixel, off the grid: inflation asks the worst point of a pixel.
  const OccupancyMap map = two_rooms();
  const Query query{map, {8, 20.5, 0}, {52, 20.5, 0}};
  const Polygon robot = Polygon::rectangle(12.0, 6.98, 6.0);
  const PlanRequest request = request_of(query, robot, Motion::turning, 0.0);
  EXPECT_NE(Planner(predictor(), options_for("RRT", Strategy::frontier)).plan(request).status,
            PlanStatus::not_connected);
}

TEST(PosePlannerCheck, AMarginIsKeptAroundAnOutline) {
  const OccupancyMap map = two_rooms();
  const Query query{map, {10, 20.5, 0}, {50, 20.5, 0}};
  PlanRequest request = request_of(query, Polygon::rectangle(6.0, 2.0, 3.0), Motion::reeds_shepp, 4.0);
  request.radius = 1.5;
  const PlanResult result = Planner(predictor(), options_for("RRTConnect", Strategy::frontier)).plan(request);
  ASSERT_TRUE(result.solved());
  const std::vector<Eigen::Vector2d> grown = Polygon::rectangle(6.0, 5.0, 3.0).vertices();
  for (std::size_t i = 0; i < result.path.size(); ++i) {
    EXPECT_FALSE(test::overlaps_blocked(map, grown, result.path[i], result.headings[i])) << i;
  }
}

TEST(PosePlannerCheck, StartAndGoalMayCoincide) {
  const OccupancyMap map = two_rooms();
  for (const Motion motion : {Motion::turning, Motion::dubins, Motion::reeds_shepp}) {
    const Query query{map, {10, 20.5, 1.0}, {10, 20.5, 1.0}};
    const PlanRequest request = request_of(query, Polygon::rectangle(6.0, 2.0, 3.0), motion, 4.0);
    const PlanResult result = Planner(nullptr, options_for("RRTstar", Strategy::uniform)).plan(request);
    EXPECT_EQ(result.status, PlanStatus::solved);
    EXPECT_EQ(result.cost, 0.0);
    EXPECT_EQ(result.headings, (std::vector<double>{1.0, 1.0}));
  }
  // turned about on the spot is another pose
  const Query query{map, {10, 20.5, 0.0}, {10, 20.5, pi / 2}};
  const PlanRequest request = request_of(query, Polygon::rectangle(6.0, 2.0, 3.0), Motion::turning, 0.0);
  const PlanResult result = Planner(nullptr, options_for("RRTConnect", Strategy::uniform)).plan(request);
  expect_honest(result, request);
  EXPECT_TRUE(result.solved());
}

TEST(PosePlannerCheck, ADiscInAPoseSpaceStaysClear) {
  Random random(73);
  int solved = 0;
  for (int i = 0; i < 8; ++i) {
    const OccupancyMap map = random_room(random, true);
    const OccupancyMap grown = inflated(map, 0.08);
    if (grown.free_mask() == std::vector<std::uint8_t>(grown.size(), 0)) continue;
    PlanRequest request{map, map.to_world(test::random_free_point(grown, random)),
                        map.to_world(test::random_free_point(grown, random)), 0.08};
    request.motion = i % 2 == 0 ? Motion::dubins : Motion::reeds_shepp;
    request.turning_radius = 0.15;
    request.goal_heading = 2.0;
    const PlanResult result = Planner(predictor(), options_for("RRTConnect", Strategy::frontier)).plan(request);
    solved += static_cast<int>(result.solved());
    for (const Eigen::Vector2d& point : result.path) {
      EXPECT_TRUE(grown.is_free(OccupancyMap::pixel_of(grown.to_pixel(point))));
    }
  }
  EXPECT_GE(solved, 4);
}

TEST(PosePlannerCheck, OfTwoTreesOneGrowsToTheGoal) {
  // OMPL's second tree takes curves that lead away from the goal
  Random random(98);
  const Polygon robot = Polygon::rectangle(3.0, 2.0, 1.0);
  PlanOptions options = options_for("RRTConnect", Strategy::uniform);
  options.iteration_limit = 300;
  int ours = 0;
  int ompls = 0;
  for (int i = 0; i < 60; ++i) {
    const OccupancyMap map = random_room(random, false);
    const Pose2 start = random_pose(map, robot, random);
    const Query query{map, start, random_pose(map, robot, random)};
    const PlanRequest request = request_of(query, robot, Motion::dubins, 4.0);
    options.seed = static_cast<std::uint64_t>(i) + 1;
    for (const Neighbors neighbors : {Neighbors::grid, Neighbors::ompl}) {
      options.neighbors = neighbors;
      const PlanResult result = Planner(nullptr, options).plan(request);
      expect_honest(result, request);
      (neighbors == Neighbors::grid ? ours : ompls) += result.solved() ? 1 : 0;
    }
  }
  EXPECT_GT(ours, ompls);
}

TEST(PosePlannerCheck, SimplifyShortensAndStaysFree) {
  Random random(74);
  int shorter = 0;
  for (const Motion motion : {Motion::plane, Motion::turning, Motion::dubins, Motion::reeds_shepp}) {
    for (int i = 0; i < 6; ++i) {
      const OccupancyMap map = random_room(random, false);
      const Polygon robot = Polygon::rectangle(4.0, 2.0, 2.0);
      const Query query{map, random_pose(map, robot, random), random_pose(map, robot, random)};
      PlanRequest request = request_of(query, robot, motion, 3.0);
      if (motion == Motion::plane) request.outline.reset();
      PlanOptions options = options_for("RRTConnect", Strategy::uniform);
      const PlanResult plain = Planner(nullptr, options).plan(request);
      options.simplify = true;
      const PlanResult simple = Planner(nullptr, options).plan(request);
      ASSERT_EQ(plain.status, simple.status);
      if (!simple.solved()) continue;
      EXPECT_LE(simple.cost, plain.cost);
      shorter += static_cast<int>(simple.cost < 0.99 * plain.cost);
      if (motion != Motion::plane) {
        expect_honest(simple, request);
        continue;
      }
      EXPECT_EQ(simple.path.front(), request.start);
      EXPECT_EQ(simple.path.back(), request.goal);
      for (std::size_t k = 1; k < simple.path.size(); ++k) {
        EXPECT_FALSE(test::crosses_blocked(map, simple.path[k - 1], simple.path[k]));
      }
    }
  }
  EXPECT_GT(shorter, 8);
}

TEST(PosePlannerCheck, WhatCannotBePlannedIsRefused) {
  const OccupancyMap map = two_rooms();
  const auto refused = [&](auto change, const char* word, const char* planner = "RRTConnect") {
    PlanRequest request{map, {10, 20.5}, {50, 20.5}};
    change(request);
    try {
      Planner(nullptr, options_for(planner, Strategy::uniform)).plan(request);
      FAIL() << "not refused: " << word;
    } catch (const RequestError& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  refused([](PlanRequest& r) { r.outline = Polygon::rectangle(6, 2, 3); }, "Motion::turning");
  refused([](PlanRequest& r) { r.motion = Motion::dubins; }, "turning_radius");
  refused([](PlanRequest& r) { r.motion = Motion::reeds_shepp; }, "turning_radius");
  refused(
      [](PlanRequest& r) {
        r.motion = Motion::reeds_shepp;
        r.turning_radius = std::nan("");
      },
      "turning_radius");
  refused([](PlanRequest& r) { r.start_heading = std::nan(""); }, "start_heading");
  refused([](PlanRequest& r) { r.goal_heading = std::numeric_limits<double>::infinity(); }, "goal_heading");
  refused(
      [](PlanRequest& r) {
        r.motion = Motion::turning;
        r.outline = Polygon::rectangle(6, 2, -1);
      },
      "reference point");
  for (const std::string& name : planner_names()) {
    if (keeps_direction(name)) continue;
    refused(
        [](PlanRequest& r) {
          r.motion = Motion::dubins;
          r.turning_radius = 3.0;
        },
        name.c_str(), name.c_str());
  }
  EXPECT_THROW(motion_from_string("crawling"), RequestError);
  EXPECT_EQ(motion_from_string("reeds_shepp"), Motion::reeds_shepp);
}

}  // namespace
}  // namespace lrrt
