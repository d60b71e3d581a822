// SPDX-License-Identifier: BSD-3-Clause
#include "grid_search.hpp"

#include "lrrt/map/shortest_path.hpp"
#include "lrrt/stopwatch.hpp"
#include "robot.hpp"

namespace lrrt::bench {

PlanResult grid_search(const Problem& problem, const PlanSuite& suite) {
  PlanResult result;
  const Stopwatch watch;
  const OccupancyMap map = planning_map(problem, suite);
  result.timings.prepare = watch.total_ms();
  const std::vector<Pixel> pixels = shortest_path(map, OccupancyMap::pixel_of(map.to_pixel(problem.start)),
                                                  OccupancyMap::pixel_of(map.to_pixel(problem.goal)));
  result.timings.total = watch.total_ms();
  result.timings.plan = result.timings.total - result.timings.prepare;
  if (pixels.empty()) {
    result.status = PlanStatus::not_connected;
    return result;
  }
  result.status = PlanStatus::solved;
  result.path.push_back(problem.start);
  for (std::size_t i = 1; i + 1 < pixels.size(); ++i) result.path.push_back(map.center(pixels[i]));
  result.path.push_back(problem.goal);
  result.cost = path_length(result.path);
  result.cost_history = {{result.timings.plan, 0, result.cost}};
  return result;
}

}  // namespace lrrt::bench
