// SPDX-License-Identifier: BSD-3-Clause
// Predict only: where would a path probably lie? For those who bring their own planner.
//
//     example_02_predict_only [map.png [output.png]]

#include <algorithm>
#include <cstdio>
#include <exception>

#include "lrrt/io/read_map.hpp"
#include "lrrt/predict/onnx_predictor.hpp"
#include "lrrt/region/picture.hpp"

int main(int argc, char** argv) try {
  const lrrt::OccupancyMap map = lrrt::read_map(argc > 1 ? argv[1] : "python/lrrt/data/maze35.png");

  const lrrt::OnnxPredictor predictor;  // load once, use for every query and from every thread
  const lrrt::Prediction prediction = predictor.predict(map, {10.5, 10.5}, {234.5, 234.5});
  const lrrt::PromisingRegion& region = prediction.region;
  const lrrt::PredictTimings& timings = prediction.timings;

  std::printf("%zu promising pixels, connected: %s, %.0f ms\n", region.area(), region.connected() ? "yes" : "no",
              timings.encode + timings.infer + timings.region);
  std::printf("most probable pixel: %.3f\n",
              static_cast<double>(*std::max_element(region.probability().begin(), region.probability().end())));
  if (argc > 2) lrrt::write_png(argv[2], {map.width(), map.height(), 3, lrrt::rgb_picture(map, region)});
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "error: %s\n", error.what());
  return 2;
}
