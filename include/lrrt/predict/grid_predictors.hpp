// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "lrrt/predict/region_predictor.hpp"

namespace lrrt {

/// A region that the caller already has, whatever made it.
class GivenRegion final : public RegionPredictor {
 public:
  /// @param width,height pixels of the maps that will be asked for. @param probability row-major, one value in [0, 1]
  /// for each. @param threshold a free pixel is promising from this probability on, in (0, 1].
  /// @throws RequestError when there is another number of values, or one out of range.
  GivenRegion(int width, int height, std::vector<float> probability, float threshold = 0.5F);
  /// @throws RequestError when the map has another size or the threshold is out of range.
  Prediction predict(const OccupancyMap& map, const Eigen::Vector2d& start, const Eigen::Vector2d& goal) const override;

 private:
  int width_;
  int height_;
  std::vector<float> probability_;
  float threshold_;
};

/// The neighbourhood of the shortest grid path (A*-RRT*: Brunner, Brüggemann, Schulz 2013). Exact where grid search is
/// affordable; the yardstick for learned regions.
class AStarPredictor final : public RegionPredictor {
 public:
  /// @param radius half the width of the region, pixels. @throws RequestError when it is negative or not finite.
  explicit AStarPredictor(double radius = 5.0);
  Prediction predict(const OccupancyMap& map, const Eigen::Vector2d& start, const Eigen::Vector2d& goal) const override;

 private:
  double radius_;
};

/// The way that an artificial potential field goes (Khatib 1986; as guidance, e.g. PB-RRT*): downhill from start and
/// from goal towards each other, pushed off by obstacles, until a local minimum ends it. For comparison: in mazes it
/// gets stuck at once.
class PotentialFieldPredictor final : public RegionPredictor {
 public:
  /// @param radius half the width of the region, pixels. @param reach distance up to which obstacles push, pixels.
  /// @throws RequestError when one of them is negative or not finite.
  explicit PotentialFieldPredictor(double radius = 5.0, double reach = 8.0);
  Prediction predict(const OccupancyMap& map, const Eigen::Vector2d& start, const Eigen::Vector2d& goal) const override;

 private:
  double radius_;
  double reach_;
};

}  // namespace lrrt
