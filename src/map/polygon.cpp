// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/map/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

#include "lrrt/error.hpp"

namespace lrrt {
namespace {

using Eigen::Vector2d;
using Vertices = std::vector<Vector2d>;

/// Farthest coordinate: squares and sums of such numbers stay finite, and no map is larger.
constexpr double farthest = 1e9;

[[noreturn]] void refuse(const std::string& what) {
  throw RequestError("robot polygon: " + what);
}

std::string name(const char* part, std::size_t i, const Vector2d& at) {
  std::ostringstream text;
  text << part << ' ' << i << " at (" << at.x() << ", " << at.y() << ')';
  return text.str();
}

/// Twice the area of a triangle; positive when its corners run counter-clockwise.
double turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Whether a point on the line through a and b lies between them.
bool between(const Vector2d& a, const Vector2d& b, const Vector2d& point) {
  return (point.array() >= a.cwiseMin(b).array()).all() && (point.array() <= a.cwiseMax(b).array()).all();
}

/// Whether two segments have a point in common.
bool meet(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const double to_c = turn(a, b, c);
  const double to_d = turn(a, b, d);
  const double to_a = turn(c, d, a);
  const double to_b = turn(c, d, b);
  if (((to_c < 0.0 && to_d > 0.0) || (to_c > 0.0 && to_d < 0.0)) &&
      ((to_a < 0.0 && to_b > 0.0) || (to_a > 0.0 && to_b < 0.0)))
    return true;
  return (to_c == 0.0 && between(a, b, c)) || (to_d == 0.0 && between(a, b, d)) || (to_a == 0.0 && between(c, d, a)) ||
         (to_b == 0.0 && between(c, d, b));
}

double twice_area(const Vertices& v) {
  double sum = 0.0;
  for (std::size_t i = 1; i + 1 < v.size(); ++i) sum += turn(v[0], v[i], v[i + 1]);
  return sum;
}

/// Every edge is held against every other one: as many as take some tenths of a second.
constexpr std::size_t most_vertices = 4096;

void check_vertices(const Vertices& v) {
  if (v.size() < 3) refuse("needs at least 3 vertices, got " + std::to_string(v.size()));
  if (v.size() > most_vertices) {
    refuse("has " + std::to_string(v.size()) + " vertices, at most " + std::to_string(most_vertices) +
           " are taken: leave out those that are much nearer to each other than a pixel");
  }
  for (std::size_t i = 0; i < v.size(); ++i) {
    // written so that a NaN fails
    if (!(std::abs(v[i].x()) <= farthest && std::abs(v[i].y()) <= farthest))
      refuse(name("vertex", i, v[i]) + " must have finite coordinates of at most 1e9 map units");
  }
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (v[i] == v[(i + 1) % v.size()])
      refuse(name("edge", i, v[i]) + " has length zero; leave out the vertex that repeats its neighbour");
  }
}

void check_edges(const Vertices& v) {
  const std::size_t n = v.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2d& a = v[i];
    const Vector2d& b = v[(i + 1) % n];
    const Vector2d& c = v[(i + 2) % n];
    if (turn(a, b, c) == 0.0 && (b - a).dot(c - b) < 0.0)
      refuse(name("edge", (i + 1) % n, b) + " turns back on the edge before it");
    for (std::size_t j = i + 2; j < n; ++j) {
      if ((j + 1) % n != i && meet(a, b, v[j], v[(j + 1) % n]))
        refuse(name("edge", i, a) + " crosses or touches " + name("edge", j, v[j]));
    }
  }
  if (twice_area(v) == 0.0) refuse("vertices 0 to " + std::to_string(n - 1) + " enclose no area");
}

double distance_to_segment(const Vector2d& a, const Vector2d& b, const Vector2d& point) {
  const Vector2d edge = b - a;
  const double share = std::clamp(edge.dot(point - a) / edge.squaredNorm(), 0.0, 1.0);
  return (a + share * edge - point).norm();
}

}  // namespace

Polygon::Polygon(Vertices vertices) : vertices_(std::move(vertices)) {
  check_vertices(vertices_);
  check_edges(vertices_);
  if (twice_area(vertices_) < 0.0) std::reverse(vertices_.begin(), vertices_.end());
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const Vector2d& next = vertices_[(i + 1) % vertices_.size()];
    nearest = std::min(nearest, distance_to_segment(vertices_[i], next, Vector2d::Zero()));
    circumscribed_radius_ = std::max(circumscribed_radius_, vertices_[i].norm());
  }
  if (contains(Vector2d::Zero())) inscribed_radius_ = nearest;
}

Polygon Polygon::rectangle(double length, double width, double rear_overhang) {
  if (!(length > 0.0 && width > 0.0))
    refuse("length " + std::to_string(length) + " and width " + std::to_string(width) + " must be positive");
  const double front = length - rear_overhang;
  const double side = width / 2.0;
  return Polygon({{-rear_overhang, -side}, {front, -side}, {front, side}, {-rear_overhang, side}});
}

bool Polygon::contains(const Vector2d& point) const {
  bool inside = false;
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const Vector2d& a = vertices_[i];
    const Vector2d& b = vertices_[(i + 1) % vertices_.size()];
    const double side = turn(a, b, point);
    if (side == 0.0 && between(a, b, point)) return true;
    // A ray to the right counts the edges it crosses; a vertex on the ray belongs to the edge above it only.
    const bool upwards = b.y() > a.y();
    if ((a.y() > point.y()) != (b.y() > point.y()) && (side > 0.0) == upwards) inside = !inside;
  }
  return inside;
}

}  // namespace lrrt
