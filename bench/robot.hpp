// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lrrt/plan.hpp"
#include "problems.hpp"

namespace lrrt::bench {

/// The outline of a suite's robot at a scale, map units; nothing for a point or a disc.
std::optional<Polygon> outline_at(const PlanSuite& suite, double scale);

/// What a row asks the library. @param problem must outlive the request.
PlanRequest request_of(const Problem& problem, const PlanSuite& suite, const PlanRow& row, const CancelToken& cancel);

/// The map without unknown pixels and with obstacles grown by the robot's radius: where a disc is a point, and its
/// outline is checked.
OccupancyMap planning_map(const OccupancyMap& map, const PlanSuite& suite, double scale);
OccupancyMap planning_map(const Problem& problem, const PlanSuite& suite);

}  // namespace lrrt::bench
