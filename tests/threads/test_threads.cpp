// SPDX-License-Identifier: BSD-3-Clause
// What threads share and must not disturb; the thread sanitizer looks at these tests too (make sanitize).
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "lrrt/planner.hpp"
#include "lrrt/predict/onnx_predictor.hpp"
#include "support.hpp"

namespace lrrt {
namespace {

/// Two ends on a map.
struct Task {
  OccupancyMap map;
  Eigen::Vector2d start;
  Eigen::Vector2d goal;
};

std::vector<Task> some_tasks(std::size_t count) {
  Random random(91);
  std::vector<Task> tasks;
  while (tasks.size() < count) {
    OccupancyMap map = test::random_map(random, 20, 60);
    const Eigen::Vector2d start = test::random_free_point(map, random);
    const Eigen::Vector2d goal = test::random_free_point(map, random);
    tasks.push_back({std::move(map), start, goal});
  }
  return tasks;
}

void expect_same(const PlanResult& one, const PlanResult& other) {
  EXPECT_EQ(one.status, other.status);
  EXPECT_EQ(one.path, other.path);
  EXPECT_EQ(one.cost, other.cost);
  EXPECT_EQ(one.iterations, other.iterations);
  EXPECT_EQ(one.nodes, other.nodes);
}

class SharedPlanner : public ::testing::TestWithParam<const char*> {};

TEST_P(SharedPlanner, AnswersAllThreadsAsItAnswersOne) {
  silence_ompl();
  PlanOptions options;
  options.planner = GetParam();
  options.iteration_limit = 300;
  options.time_limit = 600.0;
  options.simplify = true;
  const std::filesystem::path model = std::filesystem::path(LRRT_TEST_DATA) / "models" / "green.onnx";
  const Planner planner(std::make_shared<OnnxPredictor>(model), options);
  const std::vector<Task> tasks = some_tasks(6);
  std::vector<PlanResult> expected;
  for (const Task& task : tasks) expected.push_back(planner.plan({task.map, task.start, task.goal}));
  std::array<std::vector<PlanResult>, 8> results;
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < results.size(); ++k) {
    threads.emplace_back([&, k] {
      for (std::size_t i = 0; i < tasks.size(); ++i) {
        const Task& task = tasks[(i + k) % tasks.size()];
        results.at(k).push_back(planner.plan({task.map, task.start, task.goal}));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t k = 0; k < results.size(); ++k) {
    for (std::size_t i = 0; i < tasks.size(); ++i) expect_same(results.at(k)[i], expected[(i + k) % tasks.size()]);
  }
}

INSTANTIATE_TEST_SUITE_P(Threads, SharedPlanner, ::testing::Values("RRT", "RRTConnect", "RRTstar", "BITstar"));

/// A wall in the middle: a straight line would end every search.
OccupancyMap walled() {
  std::vector<std::string> rows(40, std::string(40, '.'));
  rows[20].replace(5, 30, 30, '#');
  return test::map_from_rows(rows);
}

TEST(Threads, PrmLooksFromASecondThread) {
  const OccupancyMap map = walled();
  PlanOptions options;
  options.planner = "PRM";
  options.strategy = Strategy::uniform;
  options.time_limit = 0.3;
  options.stop = Stop::limit;
  EXPECT_TRUE(Planner(nullptr, options).plan({map, {1, 1}, {38, 38}}).solved());
}

TEST(Threads, OneTokenEndsAllSearches) {
  const OccupancyMap map = walled();
  PlanOptions options;
  options.strategy = Strategy::uniform;
  options.time_limit = 600.0;
  options.stop = Stop::limit;
  const Planner planner(nullptr, options);
  PlanRequest request{map, {1, 1}, {38, 38}};
  std::vector<std::thread> threads;
  threads.reserve(4);
  for (int k = 0; k < 4; ++k) threads.emplace_back([&] { EXPECT_TRUE(planner.plan(request).solved()); });
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  request.cancel.cancel();
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace lrrt
