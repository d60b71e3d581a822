// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "lrrt/predict/region_predictor.hpp"

namespace lrrt {

/// How closely a RefinedPredictor looks.
struct RefineOptions {
  int window = 256;       ///< side of the parts of a map that are looked at again, pixels
  int most_windows = 32;  ///< of more of them nothing is looked at again: the region stays as it is
};

/// Predicts twice: the whole map, and then, one after the other, the parts of it along the way that the first region
/// shows, so that a passage thinner than a pixel of the network's picture is seen as it is.
///
/// Maps that fit into one window are predicted once. It costs another prediction for about every window's side of the
/// way.
class RefinedPredictor final : public RegionPredictor {
 public:
  /// @param predictor what predicts the map and its parts; not null.
  /// @throws RequestError when there is no predictor, or windows are smaller than 32 pixels or fewer than one.
  explicit RefinedPredictor(std::shared_ptr<const RegionPredictor> predictor, RefineOptions options = {});

  Prediction predict(const OccupancyMap& map, const Eigen::Vector2d& start, const Eigen::Vector2d& goal) const override;
  /// As much as the predictor itself sees.
  int detail() const override { return predictor_->detail(); }

 private:
  std::shared_ptr<const RegionPredictor> predictor_;
  RefineOptions options_;
};

}  // namespace lrrt
