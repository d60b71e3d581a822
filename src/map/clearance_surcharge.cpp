// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/map/clearance_surcharge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lrrt {
namespace {

/// A point lies within 0.71 pixels of its pixel's centre, and so does the one that a leap leads to.
constexpr double off_centers = 1.5;
/// No line stays in a pixel for less: else rounding could keep a walk where it is. Pixels.
constexpr double least_step = 1e-9;

/// How far it is along a direction from a coordinate to the next whole one.
double to_next_whole(double coordinate, double direction) {
  if (direction == 0.0) return std::numeric_limits<double>::infinity();
  const double next = direction > 0.0 ? std::floor(coordinate) + 1.0 : std::ceil(coordinate) - 1.0;
  return (next - coordinate) / direction;
}

}  // namespace

ClearanceSurcharge::ClearanceSurcharge(const OccupancyMap& map, const DistanceField& field,
                                       const ClearanceCost& clearance)
    : field_(field), resolution_(map.resolution()), clearance_(clearance) {}

double ClearanceSurcharge::along(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  const double length = (to - from).norm();
  if (!(length > 0.0)) return 0.0;
  const Eigen::Vector2d direction = (to - from) / length;
  double sum = 0.0;
  double done = 0.0;
  while (done < length) {
    const Eigen::Vector2d point = from + done * direction;
    const double leap = field_.at(OccupancyMap::pixel_of(point)) - clearance_.distance - 1.0 - off_centers;
    if (leap > off_centers) {  // nothing to pay as far as this is sure
      done += leap;
      continue;
    }
    const double step = std::max(
        least_step, std::min(to_next_whole(point.x(), direction.x()), to_next_whole(point.y(), direction.y())));
    const double next = std::min(length, done + step);
    const float distance = field_.at(OccupancyMap::pixel_of(from + 0.5 * (done + next) * direction));
    sum += (next - done) * (unit_cost(distance, clearance_) - 1.0);
    done = next;
  }
  return sum * resolution_;
}

}  // namespace lrrt
