// SPDX-License-Identifier: BSD-3-Clause
// consumer MAP PREFIX: plans through a map that lrrt::io reads, guided by the model that was installed in PREFIX.
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <lrrt/io/read_map.hpp>
#include <lrrt/planner.hpp>
#include <lrrt/predict/onnx_predictor.hpp>
#include <lrrt/version.hpp>
#include <memory>
#include <string>

namespace {

void require(bool holds, const std::string& what) {
  if (holds) return;
  std::cerr << "failed: " << what << '\n';
  std::exit(1);
}

/// Two free pixels far apart: the first in reading order, and the free one that is farthest from it.
std::pair<Eigen::Vector2d, Eigen::Vector2d> far_apart(const lrrt::OccupancyMap& map) {
  Eigen::Vector2d first(0.0, 0.0);
  Eigen::Vector2d last(0.0, 0.0);
  bool found = false;
  for (int r = 0; r < map.height(); ++r) {
    for (int c = 0; c < map.width(); ++c) {
      if (!map.is_free({c, r})) continue;
      if (!found) first = map.center({c, r});
      found = true;
      if ((map.center({c, r}) - first).norm() > (last - first).norm()) last = map.center({c, r});
    }
  }
  require(found, "the map has free pixels");
  return {first, last};
}

}  // namespace

int main(int argc, char** argv) {
  require(argc == 3, "usage: consumer MAP PREFIX");
  require(std::string(lrrt::version) == LRRT_EXPECTED_VERSION, "header and package agree on the version");
  const std::string model = lrrt::default_model_path().string();
  require(model.rfind(argv[2], 0) == 0, "the default model lies in the prefix, not at " + model);
  lrrt::silence_ompl();

  const lrrt::OccupancyMap map = lrrt::read_map(argv[1]);
  const auto [start, goal] = far_apart(map);
  const lrrt::Planner planner(std::make_shared<lrrt::OnnxPredictor>());
  const lrrt::PlanResult result = planner.plan({map, start, goal});

  require(result.solved(), std::string("a path is found, not ") + lrrt::to_string(result.status));
  require((result.path.front() - start).norm() < 1e-9, "the path begins at the start");
  require((result.path.back() - goal).norm() < 1e-9, "the path ends at the goal");
  require(result.draws.guided > 0, "samples came from the region");
  std::cout << "lrrt " << lrrt::version << ": a path of length " << result.cost << " after " << result.iterations
            << " iterations\n";
}
