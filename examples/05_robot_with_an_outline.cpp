// SPDX-License-Identifier: BSD-3-Clause
// A map_server map in metres, and a robot with an outline that turns on the spot.
//
//     example_05_robot_with_an_outline [map.yaml]

#include <cstdio>
#include <exception>
#include <memory>

#include "lrrt/io/read_map.hpp"
#include "lrrt/planner.hpp"
#include "lrrt/predict/onnx_predictor.hpp"

int main(int argc, char** argv) try {
  lrrt::silence_ompl();
  const lrrt::OccupancyMap map = lrrt::read_map(argc > 1 ? argv[1] : "examples/office.yaml");

  lrrt::PlanRequest request{map, {-5.7, 12.2}, {14.1, 4.4}};  // metres, y up
  request.motion = lrrt::Motion::turning;
  // An L: a base of 0.7 m × 0.5 m with an arm to the front. It drives along +x; the origin is what start and goal mean.
  request.outline.emplace(
      std::vector<Eigen::Vector2d>{{-0.3, -0.25}, {0.4, -0.25}, {0.4, 0.05}, {0.7, 0.05}, {0.7, 0.25}, {-0.3, 0.25}});

  lrrt::PlanOptions options;
  options.planner = "RRTConnect";
  options.simplify = true;
  const lrrt::Planner planner(std::make_shared<lrrt::OnnxPredictor>(), options);
  const lrrt::PlanResult result = planner.plan(request);

  std::printf("%s: %zu poses, %.0f ms\n", to_string(result.status), result.path.size(), result.timings.total);
  return result.solved() ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "error: %s\n", error.what());
  return 2;
}
