// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "judge.hpp"
#include "lrrt/planner.hpp"

namespace lrrt::property {
namespace {

/// A query and its true answer.
struct Answered {
  std::unique_ptr<Query> query;
  PlanResult result;
};

std::vector<Answered> some_answers(bool plane) {
  std::vector<Answered> answers;
  for (std::uint64_t number = 0; answers.size() < 8 && number < 400; ++number) {
    auto query = std::make_unique<Query>(number);
    if ((query->request().motion == Motion::plane) != plane) continue;
    PlanResult result = Planner(query->predictor(), query->options()).plan(query->request());
    if (!result.solved() || result.cost == 0.0) continue;
    EXPECT_EQ(judge(*query, result), "") << query->words();
    answers.push_back({std::move(query), std::move(result)});
  }
  EXPECT_EQ(answers.size(), 8U);
  return answers;
}

/// A judge that never complains proves nothing: this spoils true answers. @return how many went through all the same.
std::size_t missed(bool plane, const std::function<void(const Query&, PlanResult&)>& spoil) {
  static const std::vector<Answered> in_the_plane = some_answers(true);
  static const std::vector<Answered> of_poses = some_answers(false);
  std::size_t missed = 0;
  for (const Answered& each : plane ? in_the_plane : of_poses) {
    PlanResult result = each.result;
    spoil(*each.query, result);
    missed += static_cast<std::size_t>(judge(*each.query, result).empty());
  }
  return missed;
}

/// The middle of a pixel that is not free, or a point beside the map.
Eigen::Vector2d closed_point(const Query& query) {
  const OccupancyMap& map = query.request().map;
  for (int i = 0; i < static_cast<int>(map.size()); ++i) {
    const Pixel pixel{i % map.width(), i / map.width()};
    if (!query.ground().grown().is_free(pixel)) return map.center(pixel);
  }
  return map.to_world({-1.0, -1.0});
}

TEST(Judges, SeeAPathThroughAnObstacle) {
  const auto through = [](const Query& query, PlanResult& result) {
    const Eigen::Vector2d point = closed_point(query);
    const auto second = result.path.begin() + 1;
    result.cost += (point - result.path[0]).norm() + (point - *second).norm() - (*second - result.path[0]).norm();
    result.cost_history = {{0.0, 0, result.cost}};
    result.path.insert(second, point);
    if (!result.headings.empty()) result.headings.insert(result.headings.begin() + 1, result.headings.front());
  };
  EXPECT_EQ(missed(true, through), 0U);
  EXPECT_EQ(missed(false, through), 0U);
}

TEST(Judges, SeeWrongEndsCostsAndStatuses) {
  for (const bool plane : {true, false}) {
    const auto missed_by = [&](const auto& spoil) {
      return missed(plane, [&](const Query&, PlanResult& result) { spoil(result); });
    };
    EXPECT_EQ(missed_by([](PlanResult& r) { r.path.front().x() += 1e-9 * (1.0 + std::abs(r.path.front().x())); }), 0U);
    EXPECT_EQ(missed_by([](PlanResult& r) { r.path.pop_back(); }), 0U);
    EXPECT_EQ(missed_by([](PlanResult& r) { r.cost_history.back().cost = r.cost *= 1.001; }), 0U);
    EXPECT_EQ(missed_by([](PlanResult& r) { r.cost_history.push_back(r.cost_history.back()); }), 0U);
    EXPECT_EQ(missed_by([](PlanResult& r) { r.status = PlanStatus::not_connected; }), 0U);
    EXPECT_EQ(missed_by([](PlanResult& r) { r.status = PlanStatus::goal_occupied; }), 0U);
    EXPECT_EQ(missed_by([](PlanResult& r) { r.status = PlanStatus::start_outside; }), 0U);
    EXPECT_EQ(missed_by([](PlanResult& r) { r.status = PlanStatus::time_limit; }), 0U);
  }
  const auto turned = [](const Query&, PlanResult& result) { result.headings[result.headings.size() / 2] += 0.3; };
  EXPECT_EQ(missed(false, turned), 0U);
}

}  // namespace
}  // namespace lrrt::property
