// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lrrt/plan.hpp"

namespace lrrt {

/// @throws RequestError for an option out of its range, or options that do not go together.
void check(const PlanOptions& options);

/// @throws RequestError for a number of the request that is not finite or out of range, and for a robot that cannot
/// move as asked or that the planner of the options cannot plan for.
void check(const PlanRequest& request, const PlanOptions& options);

}  // namespace lrrt
