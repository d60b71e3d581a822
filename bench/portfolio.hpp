// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lrrt/plan.hpp"
#include "problems.hpp"

namespace lrrt::bench {

/// What a row calls OMPL's hybrid of planners.
inline constexpr const char* portfolio_name = "AnytimePathShortening";

/// OMPL's hybrid of planners: RRT-Connect and LBKPIECE, the two that OMPL itself would choose, side by side on a thread
/// each; their paths are shortened and pieces of several put together (AnytimePathShortening, Luna and others 2013). A
/// third thread of OMPL's waits for them without rest.
///
/// Its first path that is free when checked motion by motion counts. Lengths of steps are OMPL's own unless the row
/// says another one. Threads and clock decide: no two runs are alike.
PlanResult portfolio_search(const Problem& problem, const PlanSuite& suite, const PlanRow& row,
                            const CancelToken& cancel);

}  // namespace lrrt::bench
