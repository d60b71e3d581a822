// SPDX-License-Identifier: BSD-3-Clause
// A robot on its way: it moves on, crates appear in front of it, and it plans again at every step.
//
//     example_07_replanning

#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>
#include <vector>

#include "lrrt/io/read_map.hpp"
#include "lrrt/predict/onnx_predictor.hpp"
#include "lrrt/session.hpp"

namespace {

/// The point of a path after so many metres.
Eigen::Vector2d along(const std::vector<Eigen::Vector2d>& path, double distance) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double length = (path[i] - path[i - 1]).norm();
    if (distance < length) return path[i - 1] + (path[i] - path[i - 1]) * (distance / length);
    distance -= length;
  }
  return path.back();
}

/// A piece of a map, three pixels a side, with nothing but a crate on it.
lrrt::OccupancyMap crate_at(const lrrt::OccupancyMap& map, const Eigen::Vector2d& point) {
  const lrrt::Pixel middle = lrrt::OccupancyMap::pixel_of(map.to_pixel(point));
  const lrrt::OccupancyMap part = map.cropped({middle.c - 1, middle.r - 1, 3, 3});
  return part.with_cells(std::vector<lrrt::Cell>(part.size(), lrrt::Cell::occupied));
}

}  // namespace

int main() try {
  lrrt::silence_ompl();
  const lrrt::OccupancyMap map = lrrt::read_map("examples/office.yaml");
  const Eigen::Vector2d goal(14.1, 4.4);
  Eigen::Vector2d robot(-5.7, 12.2);

  lrrt::PlanRequest request{map, robot, goal, 0.2};  // a disc of 0.2 m; start and goal come with each query
  lrrt::PlanOptions options;
  options.planner = "RRTConnect";
  options.simplify = true;
  lrrt::Session session(lrrt::Planner(std::make_shared<lrrt::OnnxPredictor>(), options), request);

  lrrt::PlanResult result = session.plan({robot, goal});
  std::printf("planned: %.1f m, %.1f ms\n", result.cost, result.timings.total);
  double slowest = 0.0;
  for (int step = 1; result.solved() && (robot - goal).norm() > 1e-6; ++step) {
    robot = along(result.path, 1.0);
    if (step % 5 == 0 && result.cost > 4.0) {  // a crate of 0.3 m, three metres ahead
      session.update(crate_at(map, along(result.path, 3.0)));
    }
    result = session.replan(robot);
    if (!result.solved()) {  // it stands in a door, and there is no other: somebody takes it away
      session.update(map);
      result = session.replan(robot);
    }
    slowest = std::max(slowest, result.timings.total);
    std::printf("%3d m: %s, %5.1f m to go, %6.2f ms\n", step, to_string(result.status), result.cost,
                result.timings.total);
  }
  std::printf("arrived: %s, slowest step %.1f ms\n", result.solved() ? "yes" : "no", slowest);
  return result.solved() ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "error: %s\n", error.what());
  return 2;
}
