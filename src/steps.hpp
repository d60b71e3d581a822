// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "free_space.hpp"
#include "lrrt/plan.hpp"
#include "lrrt/predict/region_predictor.hpp"

namespace lrrt {

/// The steps of one plan, in their order. Each adds its time to the result's; a request that was cancelled goes no step
/// further.

/// Whether the caller gave up; then the result says so. Asked before each step, which itself goes on to its end.
bool given_up(const PlanRequest& request, PlanResult& result);

/// What a robot can reach on a request's map. @param predictor null where planning is unguided.
FreeSpace make_free_space(const PlanRequest& request, const RegionPredictor* predictor, PlanResult& result);

/// Looks at start and goal. @return nothing when no search is needed: then the result says how the query ends.
std::optional<Prepared> look(FreeSpace& space, const PlanRequest& request, const PlanOptions& options,
                             PlanResult& result);

/// Takes a region that was predicted on the map of the guidance, its gaps closed.
/// @throws ModelError when it is of another size.
void take_region(Prediction prediction, const Prepared& prepared, const PlanRequest& request, PlanResult& result);

/// Runs what predicts regions; where it fails and the options allow to go on without, says why.
/// @return what went wrong; empty when nothing did. @throws RequestError whatever the options say: what is wrong then
/// is what the caller gave.
std::string failure_of(const PlanOptions& options, const std::function<void()>& predict);

/// Searches, guided by the result's region where it has one.
void search(const Prepared& prepared, const PlanRequest& request, PlanOptions options, PlanResult& result);

}  // namespace lrrt
