// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lrrt/plan.hpp"
#include "problems.hpp"

namespace lrrt::bench {

/// What a row calls the grid search, where planners have their names.
inline constexpr const char* grid_search_name = "A*";

/// The rival of all planners on a plain map: A* over the grid of the map, with the library's own search. Its path runs
/// from pixel centre to pixel centre, so it is up to 8 % longer than the shortest one.
PlanResult grid_search(const Problem& problem, const PlanSuite& suite);

}  // namespace lrrt::bench
