// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "lrrt/region/geodesic.hpp"
#include "lrrt/region/promising_region.hpp"
#include "scenes.hpp"

namespace lrrt::micro {
namespace {

/// As OnnxPredictor links.
constexpr float lowest = 0.02F;
constexpr float weak = 0.1F;

/// From a probability to mask, area and connectivity; without the copy of the probability.
void make(benchmark::State& state, SceneMaker scene_of) {
  const Scene& scene = scene_of(side_of(state));
  for ([[maybe_unused]] auto _ : state) {
    state.PauseTiming();
    std::vector<float> probability = perfect(scene);
    state.ResumeTiming();
    PromisingRegion region = region_of(scene, std::move(probability));
    benchmark::DoNotOptimize(region);
  }
  count_pixels(state, scene.map);
}

/// The gaps are weakly probable, the rest of the map is not: the search stays in the region.
PromisingRegion with_weak_gaps(const Scene& scene) {
  std::vector<float> probability = perfect(scene);
  std::transform(probability.begin(), probability.end(), broken(scene).begin(), probability.begin(),
                 [](float whole, float rest) { return std::max(weak * whole, rest); });
  return region_of(scene, std::move(probability));
}

/// The whole map is as probable as the gaps: the search may have to look at all of it.
PromisingRegion in_haze(const Scene& scene) {
  std::vector<float> probability = broken(scene);
  for (float& p : probability) p = std::max(p, weak);
  return region_of(scene, std::move(probability));
}

void linked(benchmark::State& state, SceneMaker scene_of, PromisingRegion (*region_with)(const Scene&)) {
  const Scene& scene = scene_of(side_of(state));
  const PromisingRegion region = region_with(scene);
  if (region.connected()) state.SkipWithError("there is nothing to link");
  for ([[maybe_unused]] auto _ : state) {
    PromisingRegion whole = region.linked(scene.map, scene.start, scene.goal, lowest);
    benchmark::DoNotOptimize(whole);
  }
  count_pixels(state, scene.map);
}

void bridged(benchmark::State& state, SceneMaker scene_of) {
  const Scene& scene = scene_of(side_of(state));
  const PromisingRegion region = region_of(scene, broken(scene));
  if (region.connected()) state.SkipWithError("there is nothing to bridge");
  for ([[maybe_unused]] auto _ : state) {
    PromisingRegion whole = region.bridged(scene.map, scene.start, scene.goal);
    benchmark::DoNotOptimize(whole);
  }
  count_pixels(state, scene.map);
}

/// Walking distances from the goal; counts the pixels that were reached.
void geodesic(benchmark::State& state, SceneMaker scene_of, bool everywhere) {
  const Scene& scene = scene_of(side_of(state));
  const auto mask = everywhere ? scene.map.free_mask() : region_of(scene, perfect(scene)).mask();
  std::size_t reached = 0;
  for ([[maybe_unused]] auto _ : state) {
    Geodesic distances(mask, scene.map.width(), scene.map.height(), scene.goal);
    benchmark::DoNotOptimize(distances);
    reached = distances.reached().size();
  }
  state.counters["reached"] = static_cast<double>(reached);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(reached));
}

constexpr auto sides = [](auto* row) { row->Arg(256)->Arg(1024)->Unit(benchmark::kMicrosecond); };

BENCHMARK_CAPTURE(make, clutter, clutter)->Name("region/make/clutter")->Apply(sides);
BENCHMARK_CAPTURE(make, maze, maze)->Name("region/make/maze")->Apply(sides);
BENCHMARK_CAPTURE(linked, gaps, maze, with_weak_gaps)->Name("region/linked/maze/weak_gaps")->Apply(sides);
BENCHMARK_CAPTURE(linked, haze, maze, in_haze)->Name("region/linked/maze/haze")->Apply(sides);
BENCHMARK_CAPTURE(bridged, clutter, clutter)->Name("region/bridged/clutter")->Apply(sides);
BENCHMARK_CAPTURE(bridged, maze, maze)->Name("region/bridged/maze")->Apply(sides);
BENCHMARK_CAPTURE(geodesic, region, maze, false)->Name("geodesic/maze/region")->Apply(sides);
BENCHMARK_CAPTURE(geodesic, maze, maze, true)->Name("geodesic/maze/everywhere")->Apply(sides);
BENCHMARK_CAPTURE(geodesic, clutter, clutter, true)->Name("geodesic/clutter/everywhere")->Apply(sides);

}  // namespace
}  // namespace lrrt::micro
