// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lrrt/error.hpp"
#include "lrrt/map/footprint.hpp"
#include "lrrt/ompl/control_planners.hpp"
#include "lrrt/planner.hpp"
#include "lrrt/predict/grid_predictors.hpp"
#include "pose_support.hpp"
#include "support.hpp"

namespace lrrt {
namespace {

constexpr double pi = 3.141592653589793;

/// Independent of the library: where a control leads after a while, by the circle that it drives.
Pose2 after(const Pose2& from, const Control& control, double seconds) {
  const double yaw = from.yaw + control.turn_rate * seconds;
  if (std::abs(control.turn_rate) < 1e-9) {
    const double length = control.speed * seconds;
    return {from.x + length * std::cos(from.yaw), from.y + length * std::sin(from.yaw), yaw};
  }
  const double radius = control.speed / control.turn_rate;
  return {from.x + radius * (std::sin(yaw) - std::sin(from.yaw)),
          from.y - radius * (std::cos(yaw) - std::cos(from.yaw)), yaw};
}

/// True when a robot with an outline or a disc touches something, by other means than the library's.
bool blocked(const PlanRequest& request, const OccupancyMap& grown, const Pose2& pose) {
  if (!request.outline) return !grown.is_free(OccupancyMap::pixel_of(grown.to_pixel({pose.x, pose.y})));
  return test::overlaps_blocked(request.map, request.outline->vertices(), {pose.x, pose.y}, pose.yaw);
}

void expect_within_limits(const Control& control, const PlanRequest& request) {
  constexpr double hair = 1.0 + 1e-9;
  EXPECT_GT(control.duration, 0.0);
  EXPECT_LE(control.speed, request.speed * hair);
  EXPECT_GE(control.speed, -request.reverse_speed * hair);
  if (request.motion == Motion::car) {
    EXPECT_LE(std::abs(control.turn_rate) * request.turning_radius, std::abs(control.speed) * hair);
  } else {
    EXPECT_LE(std::abs(control.turn_rate), request.turn_rate * hair);
  }
}

/// Drives the controls: free at every moment, past every pose of the path in its order, and to its end.
void expect_drives_the_path(const PlanResult& result, const PlanRequest& request) {
  const OccupancyMap grown = inflated(request.map, request.outline ? 0.0 : request.radius);
  const double pixel = grown.resolution();
  Pose2 pose{request.start.x(), request.start.y(), request.start_heading};
  double seconds = 0.0;
  std::size_t passed = 0;
  const auto pass = [&](const Pose2& at) {
    EXPECT_FALSE(blocked(request, grown, at)) << "touches something after " << seconds << " s";
    const auto near = [&](std::size_t i) {
      return (result.path[i] - Eigen::Vector2d(at.x, at.y)).norm() < 0.1 * pixel &&
             test::angle_between(result.headings[i], at.yaw) < 0.1;
    };
    while (passed < result.path.size() && near(passed)) ++passed;
  };
  for (const Control& control : result.controls) {
    expect_within_limits(control, request);
    const double moved = std::abs(control.speed) / pixel + 20.0 * std::abs(control.turn_rate);
    const auto steps = static_cast<int>(std::ceil(20.0 * moved * control.duration)) + 1;
    for (int k = 0; k <= steps; ++k) pass(after(pose, control, control.duration * k / steps));
    pose = after(pose, control, control.duration);
    seconds += control.duration;
  }
  EXPECT_EQ(passed, result.path.size()) << "a pose of the path is not passed";
  EXPECT_NEAR(pose.x, result.path.back().x(), 1e-6 * pixel);
  EXPECT_NEAR(pose.y, result.path.back().y(), 1e-6 * pixel);
  EXPECT_LT(test::angle_between(pose.yaw, result.headings.back()), 1e-6);
  EXPECT_NEAR(result.cost, seconds, 1e-9 * (1.0 + seconds));
}

/// All that must hold of any result, checked by code that shares nothing with the planner.
void expect_honest(const PlanResult& result, const PlanRequest& request, const PlanOptions& options) {
  if (!result.solved()) {
    EXPECT_TRUE(result.path.empty());
    EXPECT_TRUE(result.controls.empty());
    EXPECT_TRUE(std::isinf(result.cost));
    EXPECT_TRUE(std::isinf(result.goal_distance));
    return;
  }
  ASSERT_GE(result.path.size(), 2U);
  ASSERT_EQ(result.headings.size(), result.path.size());
  EXPECT_EQ(result.path.front(), request.start);
  EXPECT_EQ(result.headings.front(), request.start_heading);
  EXPECT_NEAR(result.goal_distance, (result.path.back() - request.goal).norm(), 1e-12);
  EXPECT_NEAR(result.goal_turn, test::angle_between(result.headings.back(), request.goal_heading), 1e-12);
  EXPECT_LE(result.goal_distance, options.goal_tolerance);
  EXPECT_LE(result.goal_turn, options.heading_tolerance);
  for (std::size_t i = 1; i < result.path.size(); ++i) {
    EXPECT_LE((result.path[i] - result.path[i - 1]).norm(), request.map.get().resolution() * (1.0 + 1e-6));
  }
  expect_drives_the_path(result, request);
  ASSERT_FALSE(result.cost_history.empty());
  for (std::size_t i = 1; i < result.cost_history.size(); ++i) {
    EXPECT_LT(result.cost_history[i].cost, result.cost_history[i - 1].cost);
    EXPECT_LE(result.cost_history[i - 1].iteration, result.cost_history[i].iteration);
  }
  EXPECT_NEAR(result.cost_history.back().cost, result.cost, 1e-9 * (1.0 + result.cost));
}

/// A query of a random robot: with an outline, a disc or a point, in metres or pixels, that reverses or not.
PlanRequest random_request(const OccupancyMap& map, Motion motion, int kind, Random& random) {
  const double unit = map.resolution();
  const Polygon robot = Polygon::rectangle(unit * random.uniform(2.0, 6.0), unit * random.uniform(1.0, 3.0), unit);
  const Pose2 start = test::random_pose(map, robot, random);
  const Pose2 goal = test::random_pose(map, robot, random);
  PlanRequest request{map, {start.x, start.y}, {goal.x, goal.y}};
  if (kind % 3 != 0) request.outline = robot;
  if (kind % 3 == 0) request.radius = kind % 2 == 0 ? 0.0 : 1.3 * unit;
  request.motion = motion;
  request.start_heading = start.yaw;
  request.goal_heading = goal.yaw;
  request.speed = random.uniform(0.5, 20.0) * unit;
  request.reverse_speed = kind % 2 == 0 ? 0.0 : 0.5 * request.speed;
  request.turning_radius = random.uniform(1.0, 6.0) * unit;
  request.turn_rate = request.speed / (random.uniform(0.5, 6.0) * unit);
  return request;
}

PlanOptions options_for(const std::string& planner, const OccupancyMap& map, Strategy strategy) {
  PlanOptions options;
  options.planner = planner;
  options.strategy = strategy;
  options.goal_tolerance = 3.0 * map.resolution();
  options.heading_tolerance = 0.6;
  options.iteration_limit = 6000;
  options.time_limit = 20.0;
  return options;
}

std::shared_ptr<const RegionPredictor> predictor() {
  return std::make_shared<AStarPredictor>();
}

using Case = std::tuple<std::string, Motion>;

class DrivePlanner : public ::testing::TestWithParam<Case> {};

TEST_P(DrivePlanner, IsHonestOnRandomMaps) {
  const auto& [name, motion] = GetParam();
  Random random(91);
  constexpr int maps = 18;
  int solved = 0;
  int driven = 0;
  for (int i = 0; i < maps; ++i) {
    const OccupancyMap map = test::random_room(random, i % 2 == 0);
    const PlanRequest request = random_request(map, motion, i, random);
    PlanOptions options = options_for(
        name, map,
        std::array{Strategy::frontier, Strategy::uniform, Strategy::region}.at(static_cast<std::size_t>(i) % 3));
    options.seed = static_cast<std::uint64_t>(i);
    if (name == "SST" && i % 4 == 1) options.stop = Stop::limit;
    if (i % 5 == 4) options.heading_tolerance = pi;
    const PlanResult result = Planner(predictor(), options).plan(request);
    expect_honest(result, request, options);
    solved += static_cast<int>(result.solved());
    driven += static_cast<int>(!result.controls.empty());
  }
  EXPECT_GE(solved, name == "EST" ? 4 : maps / 2);
  EXPECT_GE(driven, name == "EST" ? 4 : maps / 3);
}

TEST_P(DrivePlanner, TheSameSeedGivesTheSameResult) {
  const auto& [name, motion] = GetParam();
  Random random(92);
  for (int i = 0; i < 3; ++i) {
    const OccupancyMap map = test::random_room(random, false);
    const PlanRequest request = random_request(map, motion, i + 1, random);
    PlanOptions options = options_for(name, map, i == 1 ? Strategy::uniform : Strategy::frontier);
    options.iteration_limit = 600;
    if (name == "SST" && i == 2) options.stop = Stop::limit;
    options.keep_tree = true;
    const PlanResult first = Planner(predictor(), options).plan(request);
    const PlanResult second = Planner(predictor(), options).plan(request);
    EXPECT_EQ(first.status, second.status);
    EXPECT_EQ(first.iterations, second.iterations);
    EXPECT_EQ(first.nodes, second.nodes);
    EXPECT_EQ(first.motion_checks, second.motion_checks);
    EXPECT_EQ(first.path, second.path);
    EXPECT_EQ(first.headings, second.headings);
    EXPECT_EQ(first.cost, second.cost);
    EXPECT_EQ(first.tree.size(), second.tree.size());
    options.seed = 2;
    const PlanResult other = Planner(predictor(), options).plan(request);
    if (first.solved() && first.iterations > 1) {
      EXPECT_NE(first.path, other.path);
    }
  }
}

std::string word(Motion motion) {
  return motion == Motion::car ? "car" : "unicycle";
}

INSTANTIATE_TEST_SUITE_P(Spaces, DrivePlanner,
                         ::testing::Combine(::testing::ValuesIn(control_planner_names()),
                                            ::testing::Values(Motion::unicycle, Motion::car)),
                         [](const auto& info) {
                           return std::get<0>(info.param) + "_" + word(std::get<1>(info.param));
                         });

/// A corridor with a bend, nine pixels wide.
OccupancyMap bend() {
  std::vector<std::string> rows(60, std::string(60, '#'));
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (r >= 4 && r < 13) rows[r].replace(4, 52, 52, '.');
    if (r >= 4 && r < 56) rows[r].replace(47, 9, 9, '.');
  }
  return test::map_from_rows(rows);
}

PlanRequest bend_request(const OccupancyMap& map) {
  PlanRequest request{map, {10.0, 8.5}, {51.5, 50.0}};
  request.outline = Polygon::rectangle(5.0, 2.5, 1.5);
  request.motion = Motion::car;
  request.goal_heading = pi / 2;
  request.speed = 10.0;
  request.turning_radius = 5.0;
  return request;
}

TEST(DrivePlannerCheck, MoreIterationsOfSstTakeLessTime) {
  const OccupancyMap map = bend();
  const PlanRequest request = bend_request(map);
  int better = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    PlanOptions options = options_for("SST", map, Strategy::frontier);
    options.seed = seed;
    const PlanResult first = Planner(predictor(), options).plan(request);
    options.stop = Stop::limit;
    options.iteration_limit = 12000;
    const PlanResult last = Planner(predictor(), options).plan(request);
    ASSERT_TRUE(first.solved() && last.solved());
    EXPECT_EQ(last.cost_history.front().cost, first.cost);
    EXPECT_LE(last.cost, first.cost);
    better += static_cast<int>(last.cost < 0.98 * first.cost);
    // no way is shorter than along the bend's inner corner
    EXPECT_GE(last.cost * request.speed, (Eigen::Vector2d(47, 13) - request.start).norm() +
                                             (request.goal - Eigen::Vector2d(47, 13)).norm() - options.goal_tolerance);
  }
  EXPECT_GE(better, 3);
}

TEST(DrivePlannerCheck, AFactorOfTheReferenceIsKept) {
  const OccupancyMap map = bend();
  const PlanRequest request = bend_request(map);
  PlanOptions options = options_for("SST", map, Strategy::frontier);
  options.stop = Stop::factor;
  options.cost_factor = 1.3;
  options.iteration_limit = 200000;
  const PlanResult result = Planner(predictor(), options).plan(request);
  ASSERT_TRUE(result.solved());
  EXPECT_LT(result.iterations, 200000U);
  EXPECT_LT(result.cost * request.speed, 1.3 * 85.0);
}

TEST(DrivePlannerCheck, AStartWithinTheTolerancesHasArrived) {
  const OccupancyMap map = bend();
  PlanRequest request = bend_request(map);
  request.goal = {11.0, 8.5};
  request.goal_heading = 0.3;
  PlanOptions options = options_for("SST", map, Strategy::uniform);
  const PlanResult result = Planner(nullptr, options).plan(request);
  EXPECT_TRUE(result.solved());
  EXPECT_EQ(result.cost, 0.0);
  EXPECT_TRUE(result.controls.empty());
  EXPECT_DOUBLE_EQ(result.goal_distance, 1.0);
  EXPECT_DOUBLE_EQ(result.goal_turn, 0.3);
  options.heading_tolerance = 0.2;
  const PlanResult turned = Planner(nullptr, options).plan(request);
  EXPECT_GT(turned.iterations, 0U);  // it has to manoeuvre
}

TEST(DrivePlannerCheck, LimitsEndASearch) {
  const OccupancyMap map = bend();
  PlanRequest request = bend_request(map);
  for (const std::string& name : control_planner_names()) {
    PlanOptions options = options_for(name, map, Strategy::uniform);
    options.goal_tolerance = 1e-6;  // hopeless
    options.iteration_limit = 100;
    EXPECT_EQ(Planner(nullptr, options).plan(request).status, PlanStatus::iteration_limit);
    options.iteration_limit = std::numeric_limits<std::size_t>::max();
    options.time_limit = 0.05;
    EXPECT_EQ(Planner(nullptr, options).plan(request).status, PlanStatus::time_limit);
  }
}

TEST(DrivePlannerCheck, DrawsAreGuidedAtTheirShare) {
  const OccupancyMap map = bend();
  const PlanRequest request = bend_request(map);
  for (const char* name : {"SST", "RRT"}) {
    PlanOptions options = options_for(name, map, Strategy::region);
    options.alpha = 0.6;
    options.goal_tolerance = 1e-6;
    options.iteration_limit = 3000;
    const PlanResult result = Planner(predictor(), options).plan(request);
    const auto draws = static_cast<double>(result.draws.guided + result.draws.uniform);
    ASSERT_GT(draws, 2000.0);
    EXPECT_NEAR(static_cast<double>(result.draws.guided) / draws, 0.6, 5.0 * std::sqrt(0.24 / draws));
  }
}

TEST(DrivePlannerCheck, WhatCannotBeDrivenIsRefused) {
  const OccupancyMap map = bend();
  const auto refused = [&](auto change, const char* text) {
    PlanRequest request = bend_request(map);
    PlanOptions options = options_for("SST", map, Strategy::uniform);
    change(request, options);
    try {
      Planner(nullptr, options).plan(request);
      FAIL() << "not refused: " << text;
    } catch (const RequestError& error) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  };
  using R = PlanRequest;
  using O = PlanOptions;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  refused([](R& r, O&) { r.speed = 0.0; }, "speed");
  refused([](R& r, O&) { r.speed = nan; }, "speed");
  refused([](R& r, O&) { r.reverse_speed = -1.0; }, "reverse_speed");
  refused([](R& r, O&) { r.reverse_speed = nan; }, "reverse_speed");
  refused([](R& r, O&) { r.turning_radius = 0.0; }, "Motion::unicycle");
  refused([](R& r, O&) { r.motion = Motion::unicycle; }, "turn_rate");
  refused(
      [](R& r, O&) {
        r.motion = Motion::unicycle;
        r.turn_rate = std::numeric_limits<double>::infinity();
      },
      "turn_rate");
  refused([](R&, O& o) { o.goal_tolerance = 0.0; }, "goal_tolerance");
  refused([](R&, O& o) { o.heading_tolerance = 0.0; }, "heading_tolerance");
  refused([](R&, O& o) { o.heading_tolerance = nan; }, "heading_tolerance");
  refused([](R&, O& o) { o.simplify = true; }, "simplify");
  refused([](R&, O& o) { o.planner = "RRTstar"; }, "SST");
  refused([](R&, O& o) { o.planner = "RRTConnect"; }, "RRTConnect");
  EXPECT_EQ(motion_from_string("car"), Motion::car);
  EXPECT_EQ(motion_from_string("unicycle"), Motion::unicycle);
}

}  // namespace
}  // namespace lrrt
