// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <memory>
#include <vector>

#include "lrrt/map/shortest_path.hpp"
#include "lrrt/sampling/frontier.hpp"
#include "lrrt/sampling/mixed_sampler.hpp"
#include "scenes.hpp"

namespace lrrt::micro {
namespace {

constexpr int side = 256;
/// The planner's longest extension, and the draws that a tree takes for one of them.
constexpr int step = 6;
constexpr std::size_t draws_a_step = 16;

/// A scene is kept for good: nobody has to own its map.
std::shared_ptr<const OccupancyMap> map_of(const Scene& scene) {
  return {std::shared_ptr<const OccupancyMap>(), &scene.map};
}

FrontierStrategy frontier_of(const Scene& scene) {
  return {map_of(scene),
          region_of(scene, perfect(scene)),
          scene.start,
          scene.goal,
          {static_cast<double>(step), Growth::one_tree}};
}

/// The shortest path, pulled taut: what a planner may have found.
std::vector<Eigen::Vector2d> path_through(const Scene& scene) {
  return smoothed(scene.map, shortest_path(scene.map, scene.start, scene.goal));
}

/// The points that a tree reaches on its way to the goal, one step apart.
std::vector<Eigen::Vector2d> growth_through(const Scene& scene) {
  const std::vector<Pixel> path = shortest_path(scene.map, scene.start, scene.goal);
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < path.size(); i += step) points.push_back(scene.map.center(path[i]));
  return points;
}

template <typename Strategy>
void draws_of(benchmark::State& state, Strategy& strategy) {
  Random random(1);
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(strategy.draw(random));
  state.SetItemsProcessed(state.iterations());
}

void uniform(benchmark::State& state) {
  UniformStrategy strategy(side, side);
  draws_of(state, strategy);
}

void uniform_informed(benchmark::State& state, SceneMaker scene_of) {
  const std::vector<Eigen::Vector2d> path = path_through(scene_of(side));
  UniformStrategy strategy(side, side);
  strategy.inform(path.front(), path.back(), path_length(path));
  draws_of(state, strategy);
}

void region(benchmark::State& state) {
  RegionStrategy strategy(region_of(maze(side), perfect(maze(side))));
  draws_of(state, strategy);
}

/// Draws while a tree grows to the goal, told of one motion a step; then from the start again.
void frontier_ahead(benchmark::State& state) {
  const std::vector<Eigen::Vector2d> growth = growth_through(maze(side));
  const FrontierStrategy fresh = frontier_of(maze(side));
  FrontierStrategy strategy = fresh;
  Random random(1);
  std::size_t draws = 0;
  std::size_t node = 1;
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(strategy.draw(random));
    if (++draws % draws_a_step != 0) continue;
    strategy.connected(growth[node - 1], growth[node]);
    if (++node < growth.size()) continue;
    state.PauseTiming();
    strategy = fresh;
    node = 1;
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations());
}

/// Draws of a search that is stuck: the band has widened to the whole region.
void frontier_stuck(benchmark::State& state) {
  FrontierStrategy strategy = frontier_of(maze(side));
  draws_of(state, strategy);
}

void frontier_after_path(benchmark::State& state, SceneMaker scene_of) {
  const std::vector<Eigen::Vector2d> path = path_through(scene_of(side));
  FrontierStrategy strategy = frontier_of(scene_of(side));
  strategy.improved(path, path_length(path));
  draws_of(state, strategy);
}

/// One motion that the strategy is told of: some of them in every iteration of a planner.
void frontier_connected(benchmark::State& state) {
  const std::vector<Eigen::Vector2d> growth = growth_through(maze(side));
  FrontierStrategy strategy = frontier_of(maze(side));
  std::size_t node = 1;
  for ([[maybe_unused]] auto _ : state) {
    strategy.connected(growth[node - 1], growth[node]);
    benchmark::ClobberMemory();
    node = node + 1 < growth.size() ? node + 1 : 1;
  }
  state.SetItemsProcessed(state.iterations());
}

/// What a query pays before its first draw.
void frontier_make(benchmark::State& state) {
  const Scene& scene = maze(side_of(state));
  const PromisingRegion region = region_of(scene, perfect(scene));
  const FrontierOptions options{static_cast<double>(step), Growth::one_tree};
  for ([[maybe_unused]] auto _ : state) {
    FrontierStrategy strategy(map_of(scene), region, scene.start, scene.goal, options);
    benchmark::DoNotOptimize(strategy);
  }
}

void mixed(benchmark::State& state) {
  const Scene& scene = maze(side);
  MixedSampler sampler(std::make_unique<RegionStrategy>(region_of(scene, perfect(scene))), {side, side}, 0.8, 1);
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(sampler.draw());
  state.SetItemsProcessed(state.iterations());
}

BENCHMARK(uniform)->Name("draw/uniform");
BENCHMARK_CAPTURE(uniform_informed, clutter, clutter)->Name("draw/uniform/informed/clutter");
BENCHMARK_CAPTURE(uniform_informed, maze, maze)->Name("draw/uniform/informed/maze");
BENCHMARK(region)->Name("draw/region");
BENCHMARK(frontier_ahead)->Name("draw/frontier/ahead");
BENCHMARK(frontier_stuck)->Name("draw/frontier/stuck");
BENCHMARK_CAPTURE(frontier_after_path, clutter, clutter)->Name("draw/frontier/after_path/clutter");
BENCHMARK_CAPTURE(frontier_after_path, maze, maze)->Name("draw/frontier/after_path/maze");
BENCHMARK(mixed)->Name("draw/mixed/region");
BENCHMARK(frontier_connected)->Name("frontier/connected");
BENCHMARK(frontier_make)->Name("frontier/make/maze")->Arg(256)->Arg(1024)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace lrrt::micro
