// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "plan_records.hpp"

namespace lrrt::bench {

/// A query is hard for a planner that needs longer than this, prediction included, milliseconds.
inline constexpr double hard_ms = 100.0;

/// What guidance is worth on the queries that are hard without it, and what it costs on the others. A run that found no
/// path counts with the time it took, so that a gain over it is the least that it can be; where neither found one there
/// is nothing to compare.
struct HardAndEasy {
  std::vector<double> gains;    ///< hard pairs: what the query cost the baseline, divided by what it cost the row
  std::size_t neither = 0;      ///< pairs without any path, neither hard nor easy
  std::vector<double> easy;     ///< easy pairs: what the query cost the row, milliseconds
  std::vector<double> allowed;  ///< easy pairs: what it cost the baseline, and the row's prediction, milliseconds
};

/// Splits pairs by what the query cost the baseline.
HardAndEasy split_by_hardness(const std::vector<PlanRecord>& baseline, const std::vector<PlanRecord>& runs);

/// A line for every guided row whose baseline is unguided; empty when there is none.
std::string hard_table(const std::vector<const RowRecords*>& rows);

}  // namespace lrrt::bench
