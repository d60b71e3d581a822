// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lrrt/predict/region_predictor.hpp"

namespace lrrt::bench {

/// Regions that no network predicts: what a suite may name as a model to see how much hangs on the prediction.
const std::vector<std::string>& made_region_names();

/// Two that a planner might be given: "astar" (around the shortest grid path: perfect, at the price of a grid search)
/// and "potential" (a potential field's way). The others are bad on purpose: "broken" (perfect with gaps), "shifted"
/// (by four pixels), "wrong" (leads away from the goal), "room" (around the start only), "noise", "empty", "full",
/// "inverted".
/// @return null for any other name.
std::shared_ptr<const RegionPredictor> made_region(const std::string& name);

}  // namespace lrrt::bench
