// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/map/shortest_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <queue>

namespace lrrt {
namespace {

constexpr float diagonal = 1.41421356F;
constexpr float unreached = std::numeric_limits<float>::infinity();

struct Step {
  int dc;
  int dr;
  float cost;
};

constexpr std::array<Step, 8> steps = {{{1, 0, 1.0F},
                                        {0, 1, 1.0F},
                                        {-1, 0, 1.0F},
                                        {0, -1, 1.0F},
                                        {1, 1, diagonal},
                                        {-1, 1, diagonal},
                                        {-1, -1, diagonal},
                                        {1, -1, diagonal}}};

struct Open {
  float estimate;
  float cost;
  Pixel pixel;
  bool operator>(const Open& other) const { return estimate > other.estimate; }
};

/// Exact distance on an empty eight-connected grid: admissible and consistent.
float octile(Pixel a, Pixel b) {
  const int dc = std::abs(a.c - b.c);
  const int dr = std::abs(a.r - b.r);
  const int shared = std::min(dc, dr);
  return static_cast<float>(std::max(dc, dr) - shared) + diagonal * static_cast<float>(shared);
}

bool can_step(const OccupancyMap& map, Pixel from, const Step& step) {
  if (!map.is_free({from.c + step.dc, from.r + step.dr})) return false;
  if (step.dc == 0 || step.dr == 0) return true;
  return map.is_free({from.c + step.dc, from.r}) && map.is_free({from.c, from.r + step.dr});
}

std::vector<Pixel> trace(const OccupancyMap& map, const std::vector<std::int8_t>& arrived_by, Pixel start, Pixel goal) {
  std::vector<Pixel> path{goal};
  for (Pixel p = goal; p != start;) {
    const Step& step = steps[static_cast<std::size_t>(arrived_by[map.index(p)])];
    p = {p.c - step.dc, p.r - step.dr};
    path.push_back(p);
  }
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace

std::vector<Pixel> shortest_path(const OccupancyMap& map, Pixel start, Pixel goal) {
  if (!map.is_free(start) || !map.is_free(goal)) return {};
  std::vector<float> cost(map.size(), unreached);
  std::vector<std::int8_t> arrived_by(map.size(), -1);
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  cost[map.index(start)] = 0.0F;
  open.push({octile(start, goal), 0.0F, start});
  while (!open.empty()) {
    const Open node = open.top();
    open.pop();
    if (node.pixel == goal) return trace(map, arrived_by, start, goal);
    if (node.cost > cost[map.index(node.pixel)]) continue;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (!can_step(map, node.pixel, steps[i])) continue;
      const Pixel next{node.pixel.c + steps[i].dc, node.pixel.r + steps[i].dr};
      const float next_cost = node.cost + steps[i].cost;
      if (next_cost >= cost[map.index(next)]) continue;
      cost[map.index(next)] = next_cost;
      arrived_by[map.index(next)] = static_cast<std::int8_t>(i);
      open.push({next_cost + octile(next, goal), next_cost, next});
    }
  }
  return {};
}

double path_length(const std::vector<Pixel>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    length += std::hypot(path[i].c - path[i - 1].c, path[i].r - path[i - 1].r);
  }
  return length;
}

}  // namespace lrrt
