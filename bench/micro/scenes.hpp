// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <benchmark/benchmark.h>

#include <vector>

#include "lrrt/map/occupancy_map.hpp"
#include "lrrt/region/promising_region.hpp"

namespace lrrt::micro {

/// A square map, and two free pixels of it with a long way between them.
struct Scene {
  OccupancyMap map;
  Pixel start;
  Pixel goal;
};

/// Makes or recalls a scene, by the side of its map in pixels.
using SceneMaker = const Scene& (*)(int side);

/// A maze of 35 blocks a side; start and goal are the ends of its longest way. Made once: the same object every time,
/// since making it is no part of what is measured.
const Scene& maze(int side);
/// Squares of 4 to 16 pixels, seeded, over about a sixth of the map; none touches its rim, so that the corners, start
/// and goal, are always joined. Made once.
const Scene& clutter(int side);
/// Nothing but free pixels. Made once.
const Scene& open_space(int side);

/// The probability of a perfect region: 1 within 5 pixels of the shortest grid path, 0 elsewhere. Made once.
const std::vector<float>& perfect(const Scene& scene);
/// The same with gaps: every third stretch of 24 pixels of the way is 0. Made once.
const std::vector<float>& broken(const Scene& scene);
/// The region that a probability stands for.
PromisingRegion region_of(const Scene& scene, std::vector<float> probability);

/// The first argument of a benchmark that has the side of a map there.
inline int side_of(const benchmark::State& state) {
  return static_cast<int>(state.range(0));
}

/// Times one call of a check after the other, over all items in turn: give so many that a processor cannot learn them
/// by heart.
template <typename Item, typename Check>
void time_checks(benchmark::State& state, const std::vector<Item>& items, const Check& check) {
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(check(items[i]));
    i = (i + 1) % items.size();
  }
  state.SetItemsProcessed(state.iterations());
}

/// Notes that each iteration looked at every pixel of a map: the table then shows pixels a second.
inline void count_pixels(benchmark::State& state, const OccupancyMap& map) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(map.size()));
}

}  // namespace lrrt::micro
