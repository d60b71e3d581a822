// SPDX-License-Identifier: BSD-3-Clause
#include "reference.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <queue>
#include <vector>

#include "corner_field.hpp"
#include "lrrt/map/clearance_bound.hpp"
#include "lrrt/map/components.hpp"
#include "lrrt/map/segment_walk.hpp"
#include "lrrt/map/shortest_path.hpp"

namespace lrrt::bench {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// How far corners lie inside free space for the visibility check, pixels. Lengths are measured without it.
constexpr double hair = 1e-6;
/// Rounding of lengths, pixels.
constexpr double tolerance = 1e-6;

/// A place where a shortest path may turn: a corner of an obstacle, or an end of the path.
struct Vertex {
  Eigen::Vector2d point;     ///< pixel coordinates
  Eigen::Vector2d obstacle;  ///< signs of the direction in which the blocked pixel lies; zero for an end
  double to_goal;            ///< lower bound of the rest of the way

  /// The point, a hair inside free space.
  Eigen::Vector2d seen_from() const { return point - hair * obstacle; }
  /// A line through a corner of a shortest path leaves the obstacle on one side: it does not point into it.
  bool tangent(const Eigen::Vector2d& direction) const {
    return direction.x() * obstacle.x() * direction.y() * obstacle.y() <= 0.0;
  }
};

/// An edge that has not been checked yet.
struct Candidate {
  double cost;  ///< least length of a path from start to goal through it
  double length;
  std::size_t from;
  std::size_t to;
  friend bool operator<(const Candidate& a, const Candidate& b) { return a.cost > b.cost; }
};

/// Length of the grid path, straightened by line of sight: some path, so no shorter than the shortest one.
double some_length(const OccupancyMap& map, const SegmentWalk& walk, const Eigen::Vector2d& start,
                   const Eigen::Vector2d& goal) {
  std::vector<Eigen::Vector2d> points{start};
  for (const Pixel p : shortest_path(map, OccupancyMap::pixel_of(start), OccupancyMap::pixel_of(goal))) {
    points.emplace_back(p.c + 0.5, p.r + 0.5);
  }
  points.push_back(goal);
  return straightened_length(points, [&](const auto& from, const auto& to) { return walk.is_free(from, to); });
}

/// Where the blocked pixel lies at a convex corner of an obstacle, as signs; zero at every other corner of pixels.
Eigen::Vector2d obstacle_at(const OccupancyMap& map, Pixel corner) {
  Eigen::Vector2d direction = Eigen::Vector2d::Zero();
  int blocked = 0;
  for (const int r : {-1, 0}) {
    for (const int c : {-1, 0}) {
      if (map.is_free({corner.c + c, corner.r + r})) continue;
      ++blocked;
      direction = {c < 0 ? -1.0 : 1.0, r < 0 ? -1.0 : 1.0};
    }
  }
  return blocked == 1 ? direction : Eigen::Vector2d::Zero();
}

/// Start, goal and the corners that a path no longer than the bound can visit.
std::vector<Vertex> vertices_within(const OccupancyMap& map, const Eigen::Vector2d& start, const Eigen::Vector2d& goal,
                                    double bound) {
  const CornerField from_start(map, start);
  const CornerField from_goal(map, goal);
  std::vector<Vertex> vertices{{start, Eigen::Vector2d::Zero(), (goal - start).norm()},
                               {goal, Eigen::Vector2d::Zero(), 0.0}};
  for (int r = 1; r < map.height(); ++r) {
    for (int c = 1; c < map.width(); ++c) {
      const double to_goal = from_goal.at_least({c, r});
      if (from_start.at_least({c, r}) + to_goal > bound) continue;
      const Eigen::Vector2d obstacle = obstacle_at(map, {c, r});
      if (!obstacle.isZero()) vertices.push_back({{c, r}, obstacle, to_goal});
    }
  }
  return vertices;
}

/// A* from vertex 0 to vertex 1. @param bound no path through a longer edge is looked at.
double lazy_search(const std::vector<Vertex>& vertices, const SegmentWalk& walk, double bound) {
  std::vector<std::uint8_t> closed(vertices.size(), 0);
  std::priority_queue<Candidate> open;
  open.push({0.0, 0.0, 0, 0});
  while (!open.empty()) {
    const Candidate best = open.top();
    open.pop();
    if (closed[best.to] != 0) continue;
    const Vertex& here = vertices[best.to];
    if (best.from != best.to && !walk.is_free(vertices[best.from].seen_from(), here.seen_from())) continue;
    if (best.to == 1) return best.length;
    closed[best.to] = 1;
    for (std::size_t to = 1; to < vertices.size(); ++to) {
      const Eigen::Vector2d edge = vertices[to].point - here.point;
      if (closed[to] != 0 || !here.tangent(edge) || !vertices[to].tangent(edge)) continue;
      const double length = best.length + edge.norm();
      const double cost = length + vertices[to].to_goal;
      if (cost <= bound) open.push({cost, length, best.to, to});
    }
  }
  return infinite;
}

}  // namespace

double shortest_length(const OccupancyMap& map, const Eigen::Vector2d& start, const Eigen::Vector2d& goal) {
  const Eigen::Vector2d from = map.to_pixel(start);
  const Eigen::Vector2d to = map.to_pixel(goal);
  if (!Components(map).joined(OccupancyMap::pixel_of(from), OccupancyMap::pixel_of(to))) return infinite;
  const ClearanceBound clearance(map);
  const SegmentWalk walk(clearance);
  const double bound = some_length(map, walk, from, to) + tolerance;
  const std::vector<Vertex> vertices = vertices_within(map, from, to, bound);
  if (vertices.size() > most_corners) return std::numeric_limits<double>::quiet_NaN();
  // The path that gave the bound is no path over corners; rounding may lose the one over corners that is as long.
  return std::min(bound, lazy_search(vertices, walk, bound)) * map.resolution();
}

}  // namespace lrrt::bench
