// SPDX-License-Identifier: BSD-3-Clause
// Plan on a picture: dark pixels are obstacles, coordinates are pixels (x right, y down).
//
//     example_01_plan_on_a_picture [map.png]

#include <cstdio>
#include <exception>
#include <memory>
#include <string>

#include "lrrt/io/read_map.hpp"
#include "lrrt/planner.hpp"
#include "lrrt/predict/onnx_predictor.hpp"

int main(int argc, char** argv) try {
  lrrt::silence_ompl();  // OMPL tells every search on the console otherwise
  const std::string picture = argc > 1 ? argv[1] : "python/lrrt/data/maze35.png";
  const lrrt::OccupancyMap map = lrrt::read_map(picture);

  lrrt::PlanOptions options;
  options.time_limit = 60.0;
  const lrrt::Planner planner(std::make_shared<lrrt::OnnxPredictor>(), options);
  const lrrt::PlanResult result = planner.plan({map, {10.5, 10.5}, {234.5, 234.5}});

  std::printf("%s: %.1f pixels, %zu iterations, %.0f ms\n", to_string(result.status), result.cost, result.iterations,
              result.timings.total);
  return result.solved() ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "error: %s\n", error.what());
  return 2;
}
