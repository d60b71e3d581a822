// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/map/shortest_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <queue>
#include <sstream>
#include <string>

#include "lrrt/error.hpp"
#include "lrrt/map/distance_field.hpp"
#include "lrrt/map/segment_walk.hpp"

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

void check(const ClearanceCost& clearance) {
  const auto allowed = [](double value) { return value >= 0.0 && std::isfinite(value); };
  if (allowed(clearance.distance) && allowed(clearance.weight)) return;
  std::ostringstream text;
  text << "clearance of " << clearance.distance << " pixels with weight " << clearance.weight
       << ": expected two finite numbers, 0 or more";
  throw RequestError(text.str());
}

bool is_plain(const ClearanceCost& clearance) {
  return clearance.distance <= 0.0 || clearance.weight <= 0.0;
}

/// Cost of a unit of length at every pixel; empty where it is 1 everywhere.
/// @param distances of the pixels to the nearest obstacle.
std::vector<float> unit_costs(const std::vector<float>& distances, const ClearanceCost& clearance) {
  if (is_plain(clearance)) return {};
  std::vector<float> costs = distances;
  for (float& value : costs) {
    value = static_cast<float>(unit_cost(value, clearance));
  }
  return costs;
}

/// Cost of a straight line between two points, summed over steps of about half a pixel.
double line_cost(const OccupancyMap& map, const std::vector<float>& costs, const Eigen::Vector2d& from,
                 const Eigen::Vector2d& to) {
  const double length = (to - from).norm();
  if (costs.empty()) return length;
  const int steps_taken = std::max(1, static_cast<int>(std::ceil(2.0 * length)));
  double sum = 0.0;
  for (int i = 0; i < steps_taken; ++i) {
    sum += costs[map.index(OccupancyMap::pixel_of(from + (to - from) * ((i + 0.5) / steps_taken)))];
  }
  return sum * length / steps_taken;
}

Eigen::Vector2d middle(Pixel p) {
  return {p.c + 0.5, p.r + 0.5};
}

}  // namespace

double unit_cost(double distance, const ClearanceCost& clearance) {
  if (is_plain(clearance)) return 1.0;
  const double lack = std::max(0.0, 1.0 - std::max(0.0, distance - 1.0) / clearance.distance);
  return 1.0 + clearance.weight * lack * lack;
}

std::vector<Pixel> shortest_path(const OccupancyMap& map, Pixel start, Pixel goal, const ClearanceCost& clearance) {
  check(clearance);
  if (!map.is_free(start) || !map.is_free(goal)) return {};
  const std::vector<float> costs =
      is_plain(clearance) ? std::vector<float>{} : unit_costs(DistanceField(map).values(), clearance);
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
      const float factor = costs.empty() ? 1.0F : 0.5F * (costs[map.index(node.pixel)] + costs[map.index(next)]);
      const float next_cost = node.cost + steps[i].cost * factor;
      if (next_cost >= cost[map.index(next)]) continue;
      cost[map.index(next)] = next_cost;
      arrived_by[map.index(next)] = static_cast<std::int8_t>(i);
      open.push({next_cost + octile(next, goal), next_cost, next});
    }
  }
  return {};
}

std::vector<Eigen::Vector2d> smoothed(const OccupancyMap& map, const std::vector<Pixel>& path,
                                      const ClearanceCost& clearance) {
  check(clearance);
  if (path.empty()) return {};
  constexpr double rounding = 1e-6;
  const ClearanceBound bound(map, std::numeric_limits<int>::max());  // the distance field itself: costs ask for it
  const std::vector<float> costs = unit_costs(bound.field().values(), clearance);
  const SegmentWalk walk(bound);
  std::vector<Eigen::Vector2d> corners{middle(path.front())};
  double along = 0.0;  // cost of the pixel path from the last corner on
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Vector2d before = middle(path[i - 1]);
    along += line_cost(map, costs, before, middle(path[i]));
    const bool straight = walk.is_free(corners.back(), middle(path[i])) &&
                          line_cost(map, costs, corners.back(), middle(path[i])) <= along * (1.0 + rounding);
    if (straight) continue;
    along = line_cost(map, costs, before, middle(path[i]));
    corners.push_back(before);
  }
  if (path.size() > 1) corners.push_back(middle(path.back()));
  return corners;
}

std::vector<std::uint8_t> widened(const OccupancyMap& map, const std::vector<Eigen::Vector2d>& points, double radius) {
  if (!(radius >= 0.0 && std::isfinite(radius))) {
    throw RequestError("a path cannot be widened by " + std::to_string(radius) + " pixels: expected 0 or more");
  }
  std::vector<float> distance(map.size(), unreached);
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  const auto reach = [&](Pixel p, float value) {
    if (!map.is_free(p) || value > static_cast<float>(radius) || value >= distance[map.index(p)]) return;
    distance[map.index(p)] = value;
    open.push({value, value, p});
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d step =
        i + 1 < points.size() ? Eigen::Vector2d(points[i + 1] - points[i]) : Eigen::Vector2d(0, 0);
    const int parts = std::max(1, static_cast<int>(std::ceil(2.0 * step.norm())));
    for (int k = 0; k < parts; ++k) reach(OccupancyMap::pixel_of(points[i] + step * k / parts), 0.0F);
  }
  while (!open.empty()) {
    const Open node = open.top();
    open.pop();
    if (node.cost > distance[map.index(node.pixel)]) continue;
    for (const Step& step : steps) {
      if (can_step(map, node.pixel, step)) {
        reach({node.pixel.c + step.dc, node.pixel.r + step.dr}, node.cost + step.cost);
      }
    }
  }
  std::vector<std::uint8_t> mask(map.size());
  std::transform(distance.begin(), distance.end(), mask.begin(),
                 [](float value) { return static_cast<std::uint8_t>(value < unreached); });
  return mask;
}

double path_length(const std::vector<Pixel>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    length += std::hypot(path[i].c - path[i - 1].c, path[i].r - path[i - 1].r);
  }
  return length;
}

double path_length(const std::vector<Eigen::Vector2d>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

}  // namespace lrrt
