// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "lrrt/plan.hpp"
#include "lrrt/predict/region_predictor.hpp"
#include "suite.hpp"

namespace lrrt::bench {

/// Plans a query, has something happen (PlanRow::after), and plans again: in the same session, or from scratch.
/// @param request the query, for the row's robot. @param scale what the suite's lengths are multiplied by.
/// @return the second plan, its times with what the session needs to hear of the change; the first where it found no
/// path.
PlanResult replanned(const PlanRequest& request, const PlanSuite& suite, const PlanRow& row,
                     const std::shared_ptr<const RegionPredictor>& predictor, double scale);

}  // namespace lrrt::bench
