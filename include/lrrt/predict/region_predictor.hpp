// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "lrrt/map/occupancy_map.hpp"
#include "lrrt/region/promising_region.hpp"

namespace lrrt {

/// One question to a predictor.
struct RegionQuery {
  Eigen::Vector2d start;  ///< map units, on a free pixel
  Eigen::Vector2d goal;   ///< map units, on a free pixel
};

/// Wall-clock time of each stage of a prediction, milliseconds.
struct PredictTimings {
  double encode = 0.0;  ///< map, start and goal to the network's input
  double infer = 0.0;   ///< the network; of several pictures at once, this one's share
  double region = 0.0;  ///< the network's output to map pixels, mask, connectivity
};

/// A promising region and what it cost.
struct Prediction {
  PromisingRegion region;    ///< where a path probably lies
  PredictTimings timings{};  ///< what each stage took
  int input_side = 0;        ///< of the network's picture, pixels; 0 without a network
};

/// Marks where a path probably lies. Implementations are safe to call from many threads at once.
class RegionPredictor {
 public:
  virtual ~RegionPredictor() = default;
  /// @param start,goal map units, on free pixels.
  /// @throws RequestError when one of them is not on a free pixel. @throws ModelError when the model fails.
  virtual Prediction predict(const OccupancyMap& map, const Eigen::Vector2d& start,
                             const Eigen::Vector2d& goal) const = 0;

  /// Predictions for many queries on one map, in their order: the same regions as predict() gives one by one. Where a
  /// network runs, it is given several pictures at once. Without queries there are no predictions.
  /// @throws RequestError that names the first query ("queries[3]: …") whose start or goal is not on a free pixel.
  /// @throws ModelError when the model fails.
  virtual std::vector<Prediction> predict_many(const OccupancyMap& map, const std::vector<RegionQuery>& queries) const;

  /// Longest side, pixels, of a map of which the predictor sees every pixel. Planner shows it larger maps coarsened
  /// down to this (OccupancyMap::coarsened), so that a prediction and what follows from it cost no more than on such a
  /// map.
  virtual int detail() const { return std::numeric_limits<int>::max(); }
};

}  // namespace lrrt
