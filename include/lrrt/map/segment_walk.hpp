// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "lrrt/map/clearance_bound.hpp"

namespace lrrt {

/// Exact collision check of straight motions of a point.
///
/// A segment is free when every pixel that it touches is free; where it passes through the common corner of four pixels
/// all of them must be free. The walk visits pixel after pixel (Amanatides and Woo 1987) and leaps where a bound of
/// the clearance shows that nothing is near, so its cost depends on the clutter, not on the length.
///
/// Holds a reference: the bound must outlive the walk. Safe to share between threads.
class SegmentWalk {
 public:
  /// A walk over the map of a bound, which must outlive it.
  explicit SegmentWalk(const ClearanceBound& clearance) : clearance_(clearance) {}

  /// True when the point, in pixel coordinates, lies on a free pixel.
  bool is_free(const Eigen::Vector2d& point) const { return clearance_.at(OccupancyMap::pixel_of(point)) > 0.0F; }
  /// True when the segment between two points, in pixel coordinates, is free. Points that are not finite are not free.
  bool is_free(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;

 private:
  const ClearanceBound& clearance_;
};

}  // namespace lrrt
