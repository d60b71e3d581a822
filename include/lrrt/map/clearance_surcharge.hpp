// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "lrrt/map/distance_field.hpp"
#include "lrrt/map/occupancy_map.hpp"
#include "lrrt/map/shortest_path.hpp"

namespace lrrt {

/// What a way costs on top of its length where it comes nearer to obstacles than one would like: unit_cost() less 1 for
/// each unit of length, of the pixels that it passes.
///
/// Holds a reference to the field. Safe to share between threads.
class ClearanceSurcharge {
 public:
  /// @param clearance with a distance above 0, pixels.
  ClearanceSurcharge(const OccupancyMap& map, const DistanceField& field, const ClearanceCost& clearance);

  /// The surcharge along a straight line, map units: exact, pixel by pixel. @param from,to pixel coordinates.
  double along(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;

 private:
  const DistanceField& field_;
  double resolution_;
  ClearanceCost clearance_;
};

}  // namespace lrrt
