// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lrrt/plan.hpp"

namespace lrrt::property {

/// The ground that a robot moves on, worked out from first principles: no code of the library but the map's cells and
/// frame.
class Ground {
 public:
  explicit Ground(const PlanRequest& request);

  /// Map units to pixels, by complex numbers instead of the library's matrix.
  Eigen::Vector2d to_pixel(const Eigen::Vector2d& world) const;
  /// The map with unknown pixels resolved, as a plain picture.
  const OccupancyMap& bare() const { return bare_; }
  /// The same with obstacles grown by the request's radius: free where every point of a pixel is as far as that from
  /// every pixel that is not free, and from the edge. Every pair of pixels was compared.
  const OccupancyMap& grown() const { return grown_; }
  /// The grown map in the frame of the request's.
  const OccupancyMap& framed() const { return framed_; }
  /// The request's radius in pixels.
  double radius() const { return radius_; }

  /// Whether a point, in pixels, is so near to the border of a pixel that rounding decides in which one it lies.
  bool on_a_border(const Eigen::Vector2d& pixel) const;

 private:
  OccupancyMap grow() const;

  const OccupancyMap& map_;
  OccupancyMap bare_;
  double radius_;
  OccupancyMap grown_;
  OccupancyMap framed_;
};

/// Pixels of a shortest way over the four neighbours; nothing where there is none.
std::vector<Pixel> shortest_way(const OccupancyMap& map, Pixel from, Pixel to);

/// Distance from a point to the nearest pixel that is not free, or to the map's edge, pixels; anything above `most`
/// where it is more than that.
double clearance(const OccupancyMap& map, const Eigen::Vector2d& point, double most);

/// Distance between a segment and a pixel; 0 where they meet.
double gap(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Pixel pixel);

}  // namespace lrrt::property
