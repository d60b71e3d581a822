// SPDX-License-Identifier: BSD-3-Clause
// A car that parks backwards: arcs and straight lines, forwards and back (Reeds-Shepp).
//
//     example_06_parking

#include <cstdio>
#include <exception>
#include <memory>
#include <vector>

#include "lrrt/planner.hpp"
#include "lrrt/predict/onnx_predictor.hpp"

namespace {

/// 20 m × 12 m at 10 cm: a lane, and under it a row of bays of 2.6 m with cars in all of them but one.
lrrt::OccupancyMap car_park() {
  constexpr int width = 200;
  constexpr int height = 120;
  std::vector<lrrt::Cell> cells;
  for (int r = 0; r < height; ++r) {
    for (int c = 0; c < width; ++c) {
      const int bay = (c - 8) / 26;
      const int across = c - 8 - 26 * bay;
      const bool in_bays = c >= 8 && bay < 7;
      const bool post = in_bays && r >= 64 && across < 2;
      const bool car = in_bays && bay != 3 && r >= 68 && r < 112 && across >= 6 && across < 23;
      cells.push_back(r < 10 || post || car ? lrrt::Cell::occupied : lrrt::Cell::free);
    }
  }
  return {width, height, std::move(cells), 0.1, lrrt::Pose2{0.0, 0.0, 0.0}};
}

}  // namespace

int main() try {
  lrrt::silence_ompl();
  const lrrt::OccupancyMap map = car_park();

  lrrt::PlanRequest request{map, {2.0, 8.5}, {10.0, 1.8}};
  request.motion = lrrt::Motion::reeds_shepp;
  request.turning_radius = 4.0;
  request.goal_heading = 1.5707963;  // nose to the lane
  // 4.2 m × 1.7 m, the origin on the rear axle.
  request.outline.emplace(std::vector<Eigen::Vector2d>{{-0.9, -0.85}, {3.3, -0.85}, {3.3, 0.85}, {-0.9, 0.85}});

  lrrt::PlanOptions options;
  options.planner = "RRTConnect";
  options.simplify = true;
  options.time_limit = 10.0;
  const lrrt::Planner planner(std::make_shared<lrrt::OnnxPredictor>(), options);
  const lrrt::PlanResult result = planner.plan(request);

  std::printf("%s: %.1f m, %.0f ms\n", to_string(result.status), result.cost, result.timings.total);
  return result.solved() ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "error: %s\n", error.what());
  return 2;
}
