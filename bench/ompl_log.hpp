// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "json.hpp"

namespace lrrt::bench {

/// A finished plan document in the log format of OMPL's Benchmark class (as of 1.5), which ompl_benchmark_statistics.py
/// and Planner Arena read. Every row of the report is a planner; with several groups of maps, every row of each group.
std::string ompl_log(const Json& document);

}  // namespace lrrt::bench
