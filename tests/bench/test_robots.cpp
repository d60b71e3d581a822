// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "campaign.hpp"
#include "hybrid_search.hpp"
#include "lrrt/map/components.hpp"
#include "lrrt/map/footprint.hpp"
#include "lrrt/map/swept_footprint.hpp"
#include "lrrt/region/geodesic.hpp"
#include "maze.hpp"
#include "portfolio.hpp"
#include "problems.hpp"
#include "replanning.hpp"
#include "replay.hpp"
#include "rival.hpp"
#include "robot.hpp"
#include "runner.hpp"
#include "suite.hpp"

namespace lrrt::bench {
namespace {

constexpr const char* cars = R"(
kind: plan
rectangle: [0.5, 0.35, 0.15]
turning_radius: 0.5
motion: reeds_shepp
maps:
  - {kind: maze, level: 7, pixels: 112, count: 2, scale: 10}
queries:
  - {kind: random, count: 3, far: 0.5}
  - {kind: farthest}
planners:
  - {name: plain, planner: RRTConnect, strategy: uniform}
  - {name: guided, planner: RRTConnect, strategy: frontier, model: astar}
  - {name: turns, planner: RRTConnect, strategy: uniform, motion: turning, simplify: true, baseline: turns}
time_limit: 20
)";

std::string with(const std::string& from, const std::string& to) {
  std::string text = cars;
  return text.replace(text.find(from), from.size(), to);
}

std::string error_of(const std::string& text) {
  try {
    parse_suite(text, "my.yaml", ".");
  } catch (const SuiteError& error) {
    return error.what();
  }
  return "no error";
}

PlanSuite body_of(const std::string& text) {
  return std::get<PlanSuite>(parse_suite(text, "my.yaml", ".").body);
}

Pose2 pose(const Eigen::Vector2d& place, double heading) {
  return {place.x(), place.y(), heading};
}

TEST(Robots, ASuiteSaysWhatMoves) {
  const PlanSuite suite = body_of(cars);
  ASSERT_TRUE(suite.outline);
  EXPECT_DOUBLE_EQ(suite.outline->inscribed_radius(), 0.15);
  EXPECT_EQ(suite.rows[0].motion, "reeds_shepp");
  EXPECT_EQ(suite.rows[2].motion, "turning");
  EXPECT_DOUBLE_EQ(suite.rows[0].turning_radius, 0.5);
  EXPECT_TRUE(suite.rows[2].options.simplify);
  EXPECT_EQ(suite.rows[2].baseline, "turns");
  EXPECT_DOUBLE_EQ(suite.maps[0].scale, 10.0);
  EXPECT_FALSE(suite.reference);
  const PlanSuite outlined = body_of(with("rectangle: [0.5, 0.35, 0.15]", "outline: [[0, 1], [-1, -1], [1, -1]]"));
  EXPECT_EQ(outlined.outline->vertices().size(), 3U);
}

TEST(Robots, WhatMakesNoSenseIsRefused) {
  const auto refused = [](const std::string& from, const std::string& to, const std::string& why) {
    const std::string error = error_of(with(from, to));
    EXPECT_NE(error.find(why), std::string::npos) << error;
    EXPECT_EQ(error.find("my.yaml:"), 0U) << error;
  };
  refused("motion: reeds_shepp", "motion: hopping", "motion: ");
  refused("motion: reeds_shepp", "motion: plane", "outline");
  refused("turning_radius: 0.5", "turning_radius: 0", "turning_radius");
  refused("[0.5, 0.35, 0.15]", "[0.5, 0.35]", "rear edge");
  refused("[0.5, 0.35, 0.15]", "[0.5, -0.35, 0.15]", "rear edge");
  refused("[0.5, 0.35, 0.15]", "[0.5, 0.35, 0.6]", "reference point");
  refused("rectangle: [0.5, 0.35, 0.15]", "outline: [[0, 0], [1, 1], [0, 1], [1, 0]]", "crosses");
  refused("rectangle: [0.5, 0.35, 0.15]", "outline: [[0, 0], 1]", "points");
  refused("time_limit: 20", "reference: true", "plane only");
  refused("far: 0.5", "far: 0.5, apart: 0.5", "either 'apart'");
  refused("far: 0.5", "far: 2", "share of the longest way");
  refused("scale: 10", "scale: 0", "factor");
  refused("far: 0.5", "far: 0.5, drivable: turning", "dubins");
  refused("far: 0.5", "far: 0.5, drivable: dubins", "a row with that motion");
  refused("planner: RRTConnect, strategy: uniform}", "planner: HybridA*, strategy: frontier}", "grid of poses");
  refused("planner: RRTConnect, strategy: uniform}", "planner: HybridA*, strategy: uniform, motion: turning}",
          "grid of poses");
  refused("planner: RRTConnect, strategy: uniform}",
          "planner: AnytimePathShortening, strategy: uniform, motion: dubins}", "OMPL's own");
  refused("planner: RRTConnect, strategy: uniform}", "planner: HybridA*, strategy: uniform, simplify: true}",
          "plans once");
  refused("baseline: turns", "baseline: nobody", "'nobody'");
  refused("planner: RRTConnect, strategy: uniform}", "planner: A*, strategy: uniform}", "no outline");
  refused("planner: RRTConnect, strategy: uniform}", "planner: BITstar, strategy: uniform, motion: dubins}", "BITstar");
  refused("- {kind: farthest}", "- {kind: points, start: [1, 2], goal: [1, 2, 3]}", "heading");
}

TEST(Robots, JsonReadsBackTheSame) {
  for (const std::string& text : {with("- {kind: farthest}", "- {kind: points, start: [1, 2, 3], goal: [4, 5, 6]}"),
                                  with("far: 0.5", "far: 0.5, drivable: reeds_shepp")}) {
    const Json json = to_json(parse_suite(text, "my.yaml", "."));
    EXPECT_EQ(to_json(parse_suite(dumped(json, 1), "again", ".")), json);
  }
  const Json json = to_json(parse_suite(with("far: 0.5", "far: 0.5, drivable: reeds_shepp"), "my.yaml", "."));
  EXPECT_EQ(json.at("maps").at(0).at("queries").at(0).at("drivable"), "reeds_shepp");
}

constexpr const char* forwards = R"(
kind: plan
rectangle: [0.5, 0.35, 0.15]
turning_radius: 0.5
motion: dubins
maps:
  - {kind: maze, level: 7, pixels: 112, count: 4, braid: 0.5, scale: 10}
queries:
  - {kind: random, count: 4, far: 0.5, drivable: dubins}
planners:
  - {name: grid, planner: HybridA*, strategy: uniform}
  - {name: grid both ways, planner: HybridA*, strategy: uniform, motion: reeds_shepp}
time_limit: 20
)";

TEST(Robots, HybridSearchFindsFreeWaysThatACarCanDrive) {
  const Suite suite = parse_suite(forwards, "my.yaml", ".");
  const auto& body = std::get<PlanSuite>(suite.body);
  const std::vector<Problem> problems = make_problems(suite);
  ASSERT_EQ(problems.size(), 16U);
  for (const Problem& p : problems) {
    const OccupancyMap map = planning_map(p, body);
    const DistanceField field(map);
    const Polygon outline = *outline_at(body, p.scale);
    const FootprintWalk walk(map, field, outline);
    const double radius = body.rows[0].turning_radius * p.scale;
    for (const PlanRow& row : body.rows) {
      const PlanResult result = hybrid_search(p, body, row, CancelToken());
      ASSERT_EQ(result.status, PlanStatus::solved) << p.query;  // they are drivable: forwards, so both ways too
      EXPECT_EQ(result.path.front(), p.start);
      EXPECT_EQ(result.path.back(), p.goal);
      EXPECT_EQ(result.headings.back(), p.goal_heading);
      double length = 0.0;
      for (std::size_t i = 1; i < result.path.size(); ++i) {
        EXPECT_TRUE(walk.is_free(pose(result.path[i], result.headings[i])));
        const Eigen::Vector2d step = result.path[i] - result.path[i - 1];
        const double turn = std::remainder(result.headings[i] - result.headings[i - 1], 2.0 * 3.141592653589793);
        const double middle = result.headings[i - 1] + 0.5 * turn;
        const double ahead = std::cos(middle) * step.x() + std::sin(middle) * step.y();
        EXPECT_NEAR(std::abs(ahead), step.norm(), 1e-3) << "sideways";
        if (row.motion == "dubins") {
          EXPECT_GT(ahead, -1e-3) << "backwards";
        }
        EXPECT_LE(std::abs(turn) * radius, step.norm() * 1.01 + 1e-3) << "too tight";
        EXPECT_LE(step.norm() + outline.circumscribed_radius() * std::abs(turn), map.resolution() * 1.001);
        length += step.norm();
      }
      EXPECT_NEAR(result.cost, length, 0.01 * length);
    }
  }
}

TEST(Robots, OmplsPortfolioIsCheckedLikeAnyPlanner) {
  const Suite suite = parse_suite(cars, "my.yaml", ".");
  const auto& body = std::get<PlanSuite>(suite.body);
  for (const Problem& p : make_problems(suite)) {
    const OccupancyMap map = planning_map(p, body);
    const DistanceField field(map);
    const FootprintWalk walk(map, field, *outline_at(body, p.scale));
    for (const PlanRow& row : {body.rows[0], body.rows[2]}) {  // both ways, and turning on the spot
      const PlanResult result = portfolio_search(p, body, row, CancelToken());
      ASSERT_EQ(result.status, PlanStatus::solved) << p.query;
      EXPECT_EQ(result.path.front(), p.start);
      EXPECT_EQ(result.path.back(), p.goal);
      for (std::size_t i = 0; i < result.path.size(); ++i) {
        EXPECT_TRUE(walk.is_free(pose(result.path[i], result.headings[i]))) << p.query;
      }
    }
  }
}

TEST(Robots, HybridSearchKnowsWhatACarCannotDrive) {
  // between walls three pixels wider than the car there is no turning round
  const OccupancyMap map(60, 8, std::vector<Cell>(480, Cell::free));
  const auto body = body_on(map, Polygon::rectangle(6.0, 5.0, 2.0));
  const auto drives = [&](Motion motion, double start, double goal) {
    const HybridSearch search(body, motion, 6.0);
    return !search.find({10.0, 4.0, start}, {45.0, 4.0, goal}, [] { return false; }).poses.empty();
  };
  constexpr double back = 3.141592653589793;
  EXPECT_TRUE(drives(Motion::dubins, 0.0, 0.0));
  EXPECT_FALSE(drives(Motion::dubins, back, back));
  EXPECT_FALSE(drives(Motion::dubins, 0.0, back));
  EXPECT_TRUE(drives(Motion::reeds_shepp, back, back));
  EXPECT_FALSE(drives(Motion::reeds_shepp, 0.0, back));
  EXPECT_THROW(HybridSearch(body, Motion::dubins, 0.05), SuiteError);
  EXPECT_THROW(HybridSearch(body, Motion::dubins, 1e300), SuiteError);
}

TEST(Robots, RivalsSayWhyThereIsNoPath) {
  const Suite suite = parse_suite(forwards, "my.yaml", ".");
  const auto& body = std::get<PlanSuite>(suite.body);
  PlanRow row = body.rows[1];
  const Problem good = make_problems(suite).front();
  for (const auto search : {&hybrid_search, &portfolio_search}) {
    Problem bad = good;
    bad.goal = {-5.0, -5.0};
    EXPECT_EQ((*search)(bad, body, row, CancelToken()).status, PlanStatus::goal_outside);
    bad.start = {0.5, 0.5};
    bad.goal = good.goal;
    EXPECT_EQ((*search)(bad, body, row, CancelToken()).status, PlanStatus::start_occupied);
    CancelToken cancelled;
    cancelled.cancel();
    EXPECT_EQ((*search)(good, body, row, cancelled).status, PlanStatus::cancelled);
  }
  row.options.iteration_limit = 3;
  const PlanResult limited = hybrid_search(good, body, row, CancelToken());
  EXPECT_EQ(limited.status, PlanStatus::iteration_limit);
  EXPECT_EQ(limited.iterations, 3U);
}

TEST(Robots, ReplayLeavesOutWhatNoRunRepeats) {
  const Json row = {{"id", "a"}, {"iterations", 0}, {"nodes", 0}, {"repeatable", false}};
  const Json other = {{"id", "b"}, {"iterations", 7}, {"nodes", 3}, {"repeatable", true}};
  Json result;
  result["rows"] = Json::array({row, other});
  const Comparison comparison = compare_replay(result, result);
  EXPECT_TRUE(comparison.same);
  EXPECT_NE(comparison.text.find("1 of 1 rows"), std::string::npos) << comparison.text;
  EXPECT_NE(comparison.text.find("1 rows, which no run repeats"), std::string::npos) << comparison.text;
}

TEST(Robots, QueriesAreFreePosesJoinedAndFarApartOnFoot) {
  const Suite suite = parse_suite(cars, "my.yaml", ".");
  const auto& body = std::get<PlanSuite>(suite.body);
  const std::vector<Problem> problems = make_problems(suite);
  ASSERT_EQ(problems.size(), 8U);
  for (const Problem& p : problems) {
    const OccupancyMap grown = planning_map(p, body);
    const DistanceField field(grown);
    const FootprintWalk walk(grown, field, *outline_at(body, p.scale));
    EXPECT_TRUE(walk.is_free(pose(p.start, p.start_heading))) << p.query;
    EXPECT_TRUE(walk.is_free(pose(p.goal, p.goal_heading))) << p.query;
    const OccupancyMap room = inflated(grown, 1.5);
    const Pixel start = OccupancyMap::pixel_of(room.to_pixel(p.start));
    const Pixel goal = OccupancyMap::pixel_of(room.to_pixel(p.goal));
    EXPECT_TRUE(Components(room).joined(start, goal));
    const Geodesic longest(room.free_mask(), room.width(), room.height(), farthest_pixels(room).first);
    const Geodesic ways(room.free_mask(), room.width(), room.height(), start);
    EXPECT_GE(ways.at(goal), 0.5 * longest.at(longest.reached().back())) << p.query;
  }
  EXPECT_NE(problems[0].start_heading, problems[1].start_heading);
  const std::vector<Problem> again = make_problems(suite);
  const std::vector<Problem> others = make_problems(parse_suite(with("far: 0.5", "far: 0.5, seed: 7"), "my.yaml", "."));
  for (std::size_t i = 0; i < problems.size(); ++i) {
    EXPECT_EQ(problems[i].start, again[i].start);
    EXPECT_EQ(problems[i].goal_heading, again[i].goal_heading);
  }
  EXPECT_NE(problems[0].start_heading, others[0].start_heading);
}

TEST(Robots, ARobotThatFitsNowhereIsRefused) {
  for (const char* scale : {"scale: 45", "scale: 100"}) {  // too wide for the corridors; too wide for a point of them
    EXPECT_THROW(make_problems(parse_suite(with("scale: 10", scale), "my.yaml", ".")), SuiteError) << scale;
  }
}

Json document_of(const Suite& suite, const IterationLimits& limits = {}) {
  const Campaign campaign = plan_campaign(suite, {}, limits);
  ResultFile results({}, header_of(suite, campaign));
  run_jobs(campaign.jobs, {2, false, {}}, results);
  std::vector<std::string> ids;
  for (const Job& job : campaign.jobs) ids.push_back(job.id);
  return results.document(ids);
}

TEST(Robots, ReplayGivesTheSame) {
  const Json before = document_of(parse_suite(with("time_limit: 20", "runs: 2"), "my.yaml", "."));
  for (const Json& row : before.at("rows")) {
    EXPECT_EQ(row.at("start").size(), 3U);
    EXPECT_EQ(row.at("solved"), true) << row.at("id");
  }
  const Json after = document_of(replayed_suite(before, "result.json"), replay_limits(before));
  EXPECT_TRUE(compare_replay(before, after).same) << compare_replay(before, after).text;
  EXPECT_EQ(before.at("rows").at(0).at("start"), after.at("rows").at(0).at("start"));
}

TEST(Robots, DetailIsARowOfItsOwn) {
  const PlanSuite suite = body_of(with("model: astar", "model: astar, detail: [16, 64]"));
  ASSERT_EQ(suite.rows.size(), 4U);
  EXPECT_EQ(suite.rows[1].name, "guided, detail 16");
  EXPECT_EQ(suite.rows[2].detail, 64);
}

TEST(Replanning, ASessionSpendsLessAndEndsAtTheSameGoal) {
  Suite suite = parse_suite(
      "{kind: plan, reference: false, radius: 1, move: 4, obstacle: 2,"
      " maps: [{kind: maze, level: 7, pixels: 70, count: 2, braid: 1, queries: [{kind: farthest}]}],"
      " planners: [{name: moved, planner: RRTConnect, strategy: uniform, after: move},"
      " {name: moved again, planner: RRTConnect, strategy: uniform, after: move, session: true},"
      " {name: blocked, planner: RRTConnect, strategy: uniform, after: obstacle},"
      " {name: blocked again, planner: RRTConnect, strategy: uniform, after: obstacle, session: true}]}",
      "my.yaml", ".");
  EXPECT_EQ(to_json(parse_suite(to_json(suite).dump(), "my.yaml", ".")), to_json(suite));
  const auto& body = std::get<PlanSuite>(suite.body);
  for (const Problem& problem : make_problems(suite)) {
    for (std::size_t i = 0; i < body.rows.size(); i += 2) {
      const auto run = [&](const PlanRow& row) {
        return replanned(request_of(problem, body, row, {}), body, row, nullptr, problem.scale);
      };
      const PlanResult scratch = run(body.rows[i]);
      const PlanResult session = run(body.rows[i + 1]);
      ASSERT_EQ(scratch.status, session.status);
      EXPECT_EQ(scratch.reused, 0.0);
      if (!session.solved()) continue;  // the obstacle fills the corridor
      EXPECT_GT(session.reused, 0.0);
      EXPECT_LT(session.iterations, scratch.iterations);
      EXPECT_EQ(session.path.front(), scratch.path.front());
      EXPECT_LT((session.path.back() - problem.goal).norm(), 1e-9);
    }
  }
}

TEST(Replanning, ASessionNeedsSomethingToHappen) {
  EXPECT_THROW(parse_suite("{kind: plan, maps: [{kind: maze, queries: [{kind: farthest}]}],"
                           " planners: [{planner: RRT, strategy: uniform, session: true}]}",
                           "my.yaml", "."),
               SuiteError);
}

}  // namespace
}  // namespace lrrt::bench
