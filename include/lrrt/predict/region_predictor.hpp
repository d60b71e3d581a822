// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>

#include "lrrt/map/occupancy_map.hpp"
#include "lrrt/region/promising_region.hpp"

namespace lrrt {

/// Wall-clock time of each stage of a prediction, milliseconds.
struct PredictTimings {
  double encode = 0.0;  ///< map, start and goal to the network's input
  double infer = 0.0;   ///< the network
  double region = 0.0;  ///< the network's output to map pixels, mask, connectivity
};

/// A promising region and what it cost.
struct Prediction {
  PromisingRegion region;
  PredictTimings timings{};
};

/// Marks where a path probably lies. Implementations are safe to call from many threads at once.
class RegionPredictor {
 public:
  virtual ~RegionPredictor() = default;
  /// @param start,goal map units, on free pixels.
  /// @throws RequestError when one of them is not on a free pixel. @throws ModelError when the model fails.
  virtual Prediction predict(const OccupancyMap& map, const Eigen::Vector2d& start,
                             const Eigen::Vector2d& goal) const = 0;
  /// Longest side, pixels, of a map of which the predictor sees every pixel. Planner shows it larger maps coarsened
  /// down to this (OccupancyMap::coarsened), so that a prediction and what follows from it cost no more than on such a
  /// map.
  virtual int detail() const { return std::numeric_limits<int>::max(); }
};

}  // namespace lrrt
