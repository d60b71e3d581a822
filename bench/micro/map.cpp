// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "lrrt/map/clearance_bound.hpp"
#include "lrrt/map/components.hpp"
#include "lrrt/map/distance_field.hpp"
#include "lrrt/map/flood.hpp"
#include "lrrt/map/footprint.hpp"
#include "lrrt/map/segment_walk.hpp"
#include "lrrt/sampling/random.hpp"
#include "scenes.hpp"

namespace lrrt::micro {
namespace {

constexpr double tau = 6.283185307179586;
/// So many that a processor cannot learn them by heart.
constexpr std::size_t segment_count = 1024;

struct Segment {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
};

/// Random segments of one length between free points, all free or all blocked on the way.
std::vector<Segment> draw_segments(const SegmentWalk& walk, int side, double length, bool free) {
  Random random(1);
  std::vector<Segment> segments;
  while (segments.size() < segment_count) {
    const Eigen::Vector2d from(random.uniform(0.0, side), random.uniform(0.0, side));
    const double angle = random.uniform(0.0, tau);
    const Eigen::Vector2d to = from + length * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    if (walk.is_free(from) && walk.is_free(to) && walk.is_free(from, to) == free) segments.push_back({from, to});
  }
  return segments;
}

/// One check of a motion: what a planner asks most often.
void segment_walk(benchmark::State& state, SceneMaker scene, double length, bool free = true) {
  constexpr int side = 512;
  const ClearanceBound clearance(scene(side).map);
  const SegmentWalk walk(clearance);
  const std::vector<Segment> segments = draw_segments(walk, side, length, free);
  time_checks(state, segments, [&](const Segment& segment) { return walk.is_free(segment.from, segment.to); });
}

void distance_field(benchmark::State& state, SceneMaker scene) {
  const OccupancyMap& map = scene(side_of(state)).map;
  for ([[maybe_unused]] auto _ : state) {
    DistanceField field(map);
    benchmark::DoNotOptimize(field);
  }
  count_pixels(state, map);
}

void flood(benchmark::State& state, SceneMaker make) {
  const Scene& scene = make(side_of(state));
  const std::vector<std::uint8_t> mask = scene.map.free_mask();
  for ([[maybe_unused]] auto _ : state) {
    Flood flood(mask, scene.map.width(), scene.map.height(), scene.start);
    benchmark::DoNotOptimize(flood);
  }
  count_pixels(state, scene.map);
}

void components(benchmark::State& state, SceneMaker scene) {
  const OccupancyMap& map = scene(side_of(state)).map;
  for ([[maybe_unused]] auto _ : state) {
    Components components(map);
    benchmark::DoNotOptimize(components);
  }
  count_pixels(state, map);
}

/// With the copy of the map that a caller has to give.
void inflation(benchmark::State& state, SceneMaker scene) {
  const OccupancyMap& map = scene(side_of(state)).map;
  for ([[maybe_unused]] auto _ : state) {
    OccupancyMap grown = inflated(map, 3.0);
    benchmark::DoNotOptimize(grown);
  }
  count_pixels(state, map);
}

BENCHMARK_CAPTURE(segment_walk, open_short, open_space, 8.0)->Name("segment_walk/open/short");
BENCHMARK_CAPTURE(segment_walk, open_long, open_space, 128.0)->Name("segment_walk/open/long");
BENCHMARK_CAPTURE(segment_walk, clutter_short, clutter, 8.0)->Name("segment_walk/clutter/short");
BENCHMARK_CAPTURE(segment_walk, clutter_long, clutter, 128.0)->Name("segment_walk/clutter/long");
BENCHMARK_CAPTURE(segment_walk, clutter_blocked, clutter, 128.0, false)->Name("segment_walk/clutter/blocked");
BENCHMARK_CAPTURE(segment_walk, maze_short, maze, 8.0)->Name("segment_walk/maze/short");
BENCHMARK_CAPTURE(segment_walk, maze_long, maze, 48.0)->Name("segment_walk/maze/long");

constexpr auto sides = [](auto* row) { row->Arg(256)->Arg(1024)->Unit(benchmark::kMicrosecond); };
constexpr auto sides_to_4096 = [](auto* row) { row->Arg(256)->Arg(1024)->Arg(4096)->Unit(benchmark::kMicrosecond); };

BENCHMARK_CAPTURE(distance_field, clutter, clutter)->Name("distance_field/clutter")->Apply(sides_to_4096);
BENCHMARK_CAPTURE(distance_field, maze, maze)->Name("distance_field/maze")->Apply(sides_to_4096);
BENCHMARK_CAPTURE(flood, clutter, clutter)->Name("flood/clutter")->Apply(sides_to_4096);
BENCHMARK_CAPTURE(flood, maze, maze)->Name("flood/maze")->Apply(sides_to_4096);
BENCHMARK_CAPTURE(components, clutter, clutter)->Name("components/clutter")->Apply(sides);
BENCHMARK_CAPTURE(components, maze, maze)->Name("components/maze")->Apply(sides);
BENCHMARK_CAPTURE(inflation, clutter, clutter)->Name("inflated/clutter")->Apply(sides);
BENCHMARK_CAPTURE(inflation, maze, maze)->Name("inflated/maze")->Apply(sides);

}  // namespace
}  // namespace lrrt::micro
