// SPDX-License-Identifier: BSD-3-Clause
// Your own map from an array, in metres, for a robot with a radius.
//
//     example_03_own_map_from_an_array

#include <cstdio>
#include <exception>
#include <memory>
#include <vector>

#include "lrrt/planner.hpp"
#include "lrrt/predict/onnx_predictor.hpp"

namespace {

/// 12 m × 8 m at 5 cm: two walls, each with a door of one metre. Row 0 is the top of the picture, y = 8 m.
lrrt::OccupancyMap two_doors() {
  constexpr int width = 240;
  constexpr int height = 160;
  std::vector<lrrt::Cell> cells;
  for (int r = 0; r < height; ++r) {
    for (int c = 0; c < width; ++c) {
      const bool first_wall = c >= 80 && c < 84 && (r < 20 || r >= 40);
      const bool second_wall = c >= 160 && c < 164 && (r < 120 || r >= 140);
      cells.push_back(first_wall || second_wall ? lrrt::Cell::occupied : lrrt::Cell::free);
    }
  }
  return {width, height, std::move(cells), 0.05, lrrt::Pose2{0.0, 0.0, 0.0}};
}

}  // namespace

int main() try {
  lrrt::silence_ompl();
  const lrrt::OccupancyMap map = two_doors();

  lrrt::PlanOptions options;
  options.time_limit = 10.0;
  const lrrt::Planner planner(std::make_shared<lrrt::OnnxPredictor>(), options);
  const lrrt::PlanResult result = planner.plan({map, {1.0, 1.0}, {11.0, 7.0}, 0.3});  // metres, y up

  std::printf("%s: %.2f m, %zu points, %.0f ms\n", to_string(result.status), result.cost, result.path.size(),
              result.timings.total);
  return result.solved() ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "error: %s\n", error.what());
  return 2;
}
