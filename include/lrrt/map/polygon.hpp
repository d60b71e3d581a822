// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace lrrt {

/// Outline of a robot in its own frame: the reference point at the origin, the heading along +x, in map units. A simple
/// polygon, convex or concave; the outline and what it encloses belong to it.
class Polygon {
 public:
  /// @param vertices corners in order, either way round; the last is joined to the first. Edge i runs from vertex i to
  /// the next one.
  /// @throws RequestError that names the vertex or the edge: fewer than 3 vertices, a coordinate that is not finite or
  /// beyond 1e9, an edge of length zero, edges that cross or touch each other, no area.
  explicit Polygon(std::vector<Eigen::Vector2d> vertices);

  /// A rectangle whose reference point lies on its centre line, `rear_overhang` ahead of the rear edge. Map units.
  /// @throws RequestError when length or width is not positive, or a number is not finite or beyond 1e9.
  static Polygon rectangle(double length, double width, double rear_overhang);

  /// Corners, counter-clockwise where y points up.
  const std::vector<Eigen::Vector2d>& vertices() const { return vertices_; }
  /// Radius of the largest disc around the reference point that fits inside; 0 when that point is not inside.
  double inscribed_radius() const { return inscribed_radius_; }
  /// Radius of the smallest disc around the reference point that holds the polygon.
  double circumscribed_radius() const { return circumscribed_radius_; }
  /// True for a point, in the robot's frame, inside the outline or on it.
  bool contains(const Eigen::Vector2d& point) const;

 private:
  std::vector<Eigen::Vector2d> vertices_;
  double inscribed_radius_ = 0.0;
  double circumscribed_radius_ = 0.0;
};

}  // namespace lrrt
