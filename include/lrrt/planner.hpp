// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "lrrt/plan.hpp"
#include "lrrt/predict/region_predictor.hpp"

namespace lrrt {

/// The one call: a map, a start and a goal in, a path out (the paper's Algorithm L-RRT*).
///
/// Holds no state between calls; one planner may serve many threads at once.
class Planner {
 public:
  /// @param predictor marks the promising region; may be null, then planning is unguided.
  /// @throws RequestError when an option is out of range or the strategy needs a predictor and there is none.
  explicit Planner(std::shared_ptr<const RegionPredictor> predictor = nullptr, PlanOptions options = {});

  /// The options that every call uses.
  const PlanOptions& options() const { return options_; }
  /// Null where planning is unguided.
  const std::shared_ptr<const RegionPredictor>& predictor() const { return predictor_; }

  /// What the predictor throws comes through, too, unless PlanOptions::on_predict_error says otherwise.
  /// @throws RequestError when a number of the request is not finite. @throws ModelError when the prediction fails.
  PlanResult plan(const PlanRequest& request) const;

 private:
  std::shared_ptr<const RegionPredictor> predictor_;
  PlanOptions options_;
};

/// OMPL tells every search on the console. This keeps it to warnings; it changes OMPL's own global log level.
void silence_ompl();

}  // namespace lrrt
