// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lrrt/error.hpp"
#include "lrrt/map/footprint.hpp"
#include "lrrt/predict/grid_predictors.hpp"
#include "lrrt/session.hpp"
#include "pose_support.hpp"
#include "support.hpp"

namespace lrrt {
namespace {

constexpr double pi = 3.141592653589793;
constexpr int side = 90;

/// Blocks on a free ground, in metres every second time.
OccupancyMap random_ground(Random& random, bool metric) {
  std::vector<Cell> cells(static_cast<std::size_t>(side) * side, Cell::free);
  for (int i = 0; i < 8; ++i) {
    const auto c0 = static_cast<int>(random.index(side - 8));
    const auto r0 = static_cast<int>(random.index(side - 8));
    for (int r = r0; r < r0 + 8; ++r) {
      for (int c = c0; c < c0 + 8; ++c) cells[static_cast<std::size_t>(r * side + c)] = Cell::occupied;
    }
  }
  if (!metric) return {side, side, std::move(cells)};
  return {side, side, std::move(cells), 0.05, {-3.0, 7.0, random.uniform(-pi, pi)}};
}

/// A small robot for a map: a disc in the plane, a rectangle elsewhere.
PlanRequest robot_on(const OccupancyMap& map, Motion motion) {
  PlanRequest robot{map, map.center({0, 0}), map.center({0, 0})};
  robot.motion = motion;
  const double pixel = map.resolution();
  if (motion == Motion::plane) {
    robot.radius = 1.5 * pixel;
  } else {
    robot.outline = Polygon::rectangle(6.0 * pixel, 3.0 * pixel, 2.0 * pixel);
    robot.turning_radius = 5.0 * pixel;
  }
  return robot;
}

/// Whether the robot fits at a pose, by code that shares nothing with the library's checks.
bool fits(const PlanRequest& robot, const OccupancyMap& map, const Pose2& pose) {
  const Eigen::Vector2d at(pose.x, pose.y);
  if (robot.outline) return !test::overlaps_blocked(map, robot.outline->vertices(), at, pose.yaw);
  const OccupancyMap grown = inflated(map, robot.radius);
  return grown.is_free(OccupancyMap::pixel_of(grown.to_pixel(at)));
}

Pose2 random_pose(const PlanRequest& robot, const OccupancyMap& map, Random& random) {
  for (;;) {
    const Eigen::Vector2d at = map.to_world({random.uniform(0, side), random.uniform(0, side)});
    const Pose2 pose{at.x(), at.y(), robot.outline ? random.uniform(-pi, pi) : 0.0};
    if (fits(robot, map, pose)) return pose;
  }
}

Query query_of(const Pose2& start, const Pose2& goal) {
  return {{start.x, start.y}, {goal.x, goal.y}, start.yaw, goal.yaw};
}

/// What must hold of a path on the map as it is now.
void expect_honest(const PlanResult& result, const PlanRequest& robot, const OccupancyMap& map, const Query& query) {
  if (!result.solved()) return;
  ASSERT_LT((result.path.front() - query.start).norm(), 1e-9);
  ASSERT_LT((result.path.back() - query.goal).norm(), 1e-9);
  double length = 0.0;
  const OccupancyMap grown = inflated(map, robot.radius);
  for (std::size_t i = 0; i < result.path.size(); ++i) {
    if (i > 0) length += (result.path[i] - result.path[i - 1]).norm();
    if (robot.outline) {
      ASSERT_FALSE(test::overlaps_blocked(map, robot.outline->vertices(), result.path[i], result.headings[i]));
    } else if (i > 0) {
      ASSERT_FALSE(test::crosses_blocked(grown, grown.to_pixel(result.path[i - 1]), grown.to_pixel(result.path[i])));
    }
  }
  ASSERT_TRUE(robot.outline || std::abs(result.cost - length) < 1e-6);
  ASSERT_GE(result.cost, length - 1e-6);  // told in chords of arcs, and turns may cost beside
  ASSERT_EQ(result.cost_history.back().cost, result.cost);
  ASSERT_GE(result.reused, 0.0);
  ASSERT_LE(result.reused, 1.0 + 1e-12);
}

Planner planner_for(Strategy strategy, Motion motion = Motion::plane) {
  PlanOptions options;
  options.planner = motion == Motion::dubins ? "RRT" : "RRTConnect";
  options.strategy = strategy;
  options.iteration_limit = 2000;
  return Planner(std::make_shared<AStarPredictor>(), options);
}

class EveryMotion : public ::testing::TestWithParam<Motion> {};

TEST_P(EveryMotion, ASessionPlansAsThePlannerDoes) {
  Random random(71);
  for (int i = 0; i < 4; ++i) {
    const OccupancyMap map = random_ground(random, i % 2 == 0);
    const PlanRequest robot = robot_on(map, GetParam());
    const Planner planner = planner_for(i < 2 ? Strategy::uniform : Strategy::frontier, GetParam());
    Session session(planner, robot);
    for (int k = 0; k < 4; ++k) {
      const Query query = query_of(random_pose(robot, map, random), random_pose(robot, map, random));
      PlanRequest request = robot;
      request.start = query.start;
      request.goal = query.goal;
      request.start_heading = query.start_heading;
      request.goal_heading = query.goal_heading;
      const PlanResult alone = planner.plan(request);
      const PlanResult together = session.plan(query);
      ASSERT_EQ(together.status, alone.status);
      ASSERT_EQ(together.path, alone.path);
      ASSERT_EQ(together.headings, alone.headings);
      ASSERT_EQ(together.iterations, alone.iterations);
    }
  }
}

TEST_P(EveryMotion, ManyQueriesGiveWhatTheyGiveOneByOne) {
  Random random(73);
  const OccupancyMap map = random_ground(random, true);
  const PlanRequest robot = robot_on(map, GetParam());
  Session session(planner_for(Strategy::frontier, GetParam()), robot);
  std::vector<Query> queries;
  for (int i = 0; i < 6; ++i) {
    queries.push_back(query_of(random_pose(robot, map, random), random_pose(robot, map, random)));
  }
  queries[2].goal = map.to_world({-5.0, 3.0});
  const std::vector<PlanResult> together = session.plan(queries);
  ASSERT_EQ(together.size(), queries.size());
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const PlanResult alone = session.plan(queries[i]);
    EXPECT_EQ(together[i].status, alone.status);
    EXPECT_EQ(together[i].path, alone.path);
    EXPECT_EQ(together[i].iterations, alone.iterations);
  }
  EXPECT_EQ(together[2].status, PlanStatus::goal_outside);
  EXPECT_TRUE(session.plan(std::vector<Query>{}).empty());
}

/// A drive: the robot follows its path by fits and starts, blocks appear and vanish, some of them on the path.
TEST_P(EveryMotion, ReplanningIsHonestWhileTheMapChanges) {
  Random random(72);
  int kept = 0;
  int mended = 0;
  for (int i = 0; i < 12; ++i) {
    OccupancyMap map = random_ground(random, i % 2 == 0);
    const PlanRequest robot = robot_on(map, GetParam());
    Session session(planner_for(Strategy::uniform, GetParam()), robot);
    const Pose2 goal = random_pose(robot, map, random);
    PlanResult result = session.plan(query_of(random_pose(robot, map, random), goal));
    for (int step = 0; step < 10 && result.solved(); ++step) {
      const std::size_t at = random.index(1 + result.path.size() / 4);
      Pose2 here{result.path[at].x(), result.path[at].y(), robot.outline ? result.headings[at] : 0.0};
      if (step % 3 == 1) here.x += random.uniform(-1.0, 1.0) * map.resolution();
      if (step % 3 == 2) {
        const std::size_t ahead = at + random.index(result.path.size() - at);
        const Pixel middle = OccupancyMap::pixel_of(map.to_pixel(result.path[ahead]));
        const PixelBox box{std::clamp(middle.c - 2, 0, side - 5), std::clamp(middle.r - 2, 0, side - 5), 5, 5};
        const Cell cell = step % 2 == 0 ? Cell::occupied : Cell::free;
        const OccupancyMap part = map.cropped(box).with_cells(std::vector<Cell>(25, cell));
        session.update(part);
        std::vector<Cell> cells = map.cells();
        for (int k = 0; k < 25; ++k) cells[map.index({box.c + k % 5, box.r + k / 5})] = cell;
        map = map.with_cells(std::move(cells));
        ASSERT_EQ(session.map().cells(), map.cells());
      }
      const Query query = query_of(here, goal);
      result = session.replan(query.start, query.start_heading);
      expect_honest(result, robot, map, query);
      if (HasFatalFailure()) return;
      kept += static_cast<int>(result.reused == 1.0);
      mended += static_cast<int>(result.reused > 0.0 && result.reused < 1.0);
      if (!result.solved() && fits(robot, map, here) && fits(robot, map, goal)) {
        EXPECT_NE(result.status, PlanStatus::start_occupied);
        EXPECT_NE(result.status, PlanStatus::goal_occupied);
      }
    }
  }
  EXPECT_GT(kept, 5);
  EXPECT_GT(mended, 5);
}

INSTANTIATE_TEST_SUITE_P(Session, EveryMotion,
                         ::testing::Values(Motion::plane, Motion::turning, Motion::dubins, Motion::reeds_shepp));

TEST(Session, KeepsAPathThatIsStillFree) {
  const OccupancyMap map(60, 40, std::vector<Cell>(2400, Cell::free));
  Session session(planner_for(Strategy::uniform), {map, {0.5, 0.5}, {0.5, 0.5}});
  const PlanResult first = session.plan({{5.5, 5.5}, {50.5, 30.5}});
  const PlanResult again = session.replan({5.5, 5.5});
  EXPECT_EQ(again.path, first.path);
  EXPECT_NEAR(again.cost, first.cost, 1e-9);
  EXPECT_EQ(again.reused, 1.0);
  EXPECT_EQ(again.iterations, 0U);
  const PlanResult arrived = session.replan({50.5, 30.5});
  EXPECT_TRUE(arrived.solved());
  EXPECT_EQ(arrived.path.size(), 2U);
  EXPECT_EQ(arrived.cost, 0.0);
}

TEST(Session, PlansAnewWhereThePathIsCutOff) {
  const std::vector<std::string> rows(30, std::string(60, '.'));
  const OccupancyMap map = test::map_from_rows(rows);
  Session session(planner_for(Strategy::uniform), {map, {0.5, 0.5}, {0.5, 0.5}});
  ASSERT_TRUE(session.plan({{2.5, 2.5}, {57.5, 2.5}}).solved());
  std::vector<std::string> wall = rows;
  for (std::string& row : wall) row[30] = '#';
  session.update(test::map_from_rows(wall));
  EXPECT_EQ(session.replan({2.5, 2.5}).status, PlanStatus::not_connected);
  wall.back()[30] = '.';  // far from the path
  session.update(test::map_from_rows(wall));
  const PlanResult round = session.replan({2.5, 2.5});
  EXPECT_TRUE(round.solved());
  EXPECT_EQ(round.reused, 0.0);
}

TEST(Session, RefusesWhatItCannotDo) {
  const OccupancyMap map(20, 20, std::vector<Cell>(400, Cell::free));
  Session session(planner_for(Strategy::uniform), {map, {0.5, 0.5}, {0.5, 0.5}});
  EXPECT_THROW(session.replan({1.0, 1.0}), RequestError);
  EXPECT_THROW(session.plan({{std::nan(""), 1.0}, {2.0, 2.0}}), RequestError);
  EXPECT_THROW(session.update(OccupancyMap(21, 20, std::vector<Cell>(420, Cell::free))), MapError);
  const OccupancyMap metric(20, 20, std::vector<Cell>(400, Cell::free), 0.5, {});
  EXPECT_THROW(session.update(metric), MapError);
  PlanRequest wrong{map, {0.5, 0.5}, {0.5, 0.5}};
  wrong.motion = Motion::dubins;  // without a turning radius
  EXPECT_THROW(Session(planner_for(Strategy::uniform), wrong), RequestError);
}

TEST(Session, GoesOnWithoutAPredictionWhereItIsAllowedTo) {
  class Broken final : public RegionPredictor {
    Prediction predict(const OccupancyMap&, const Eigen::Vector2d&, const Eigen::Vector2d&) const override {
      throw ModelError("the model is broken");
    }
  };
  const OccupancyMap map(20, 20, std::vector<Cell>(400, Cell::free));
  const PlanRequest robot{map, {0.5, 0.5}, {0.5, 0.5}};
  const std::vector<Query> queries{{{1.5, 1.5}, {18.5, 18.5}}, {{1.5, 1.5}, {3.5, 18.5}}};
  PlanOptions options;
  EXPECT_THROW(Session(Planner(std::make_shared<Broken>(), options), robot).plan(queries), ModelError);
  options.on_predict_error = OnPredictError::unguided;
  for (const PlanResult& result : Session(Planner(std::make_shared<Broken>(), options), robot).plan(queries)) {
    EXPECT_TRUE(result.solved());
    EXPECT_EQ(result.predict_error, "the model is broken");
  }
}

TEST(Session, CanBeMoved) {
  const OccupancyMap map(20, 20, std::vector<Cell>(400, Cell::free));
  Session one(planner_for(Strategy::uniform), {map, {0.5, 0.5}, {0.5, 0.5}});
  ASSERT_TRUE(one.plan({{1.5, 1.5}, {18.5, 18.5}}).solved());
  Session other = std::move(one);
  EXPECT_TRUE(other.replan({1.5, 1.5}).solved());
}

}  // namespace
}  // namespace lrrt
