// SPDX-License-Identifier: BSD-3-Clause
#include "hard_queries.hpp"

#include <algorithm>
#include <map>

#include "statistics.hpp"
#include "table.hpp"

namespace lrrt::bench {
namespace {

double share_of(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return quantile(values, share);
}

std::string factor(const std::vector<double>& gains, double share) {
  return gains.empty() ? "-" : short_number(share_of(gains, share)) + "×";
}

std::string solved(const std::vector<PlanRecord>& runs) {
  const auto count = std::count_if(runs.begin(), runs.end(), [](const PlanRecord& r) { return r.solved; });
  return std::to_string(count) + "/" + std::to_string(runs.size());
}

}  // namespace

HardAndEasy split_by_hardness(const std::vector<PlanRecord>& baseline, const std::vector<PlanRecord>& runs) {
  std::map<std::string, const PlanRecord*> by_query;
  for (const PlanRecord& run : baseline) by_query[run.query] = &run;
  HardAndEasy result;
  for (const PlanRecord& run : runs) {
    const auto pair = by_query.find(run.query);
    if (pair == by_query.end()) continue;
    const PlanRecord& base = *pair->second;
    if (!base.solved && !run.solved) {
      ++result.neither;
    } else if (!base.solved || base.cost > hard_ms) {
      result.gains.push_back(base.cost / run.cost);
    } else {
      result.easy.push_back(run.cost);
      result.allowed.push_back(base.cost + run.prediction);
    }
  }
  return result;
}

std::string hard_table(const std::vector<const RowRecords*>& rows) {
  Table table({"hard and easy queries", "solved", "without", "neither", "hard", "gain: 90 % have", "median",
               "10 % have", "easy", "cost, ms", "without, and prediction"});
  bool any = false;
  for (const RowRecords* row : rows) {
    const auto base =
        std::find_if(rows.begin(), rows.end(), [&](const RowRecords* r) { return r->planner == row->baseline; });
    if (!row->guided || base == rows.end() || (*base)->guided) continue;
    any = true;
    const HardAndEasy split = split_by_hardness((*base)->runs, row->runs);
    table.add({row->planner, solved(row->runs), solved((*base)->runs), std::to_string(split.neither),
               std::to_string(split.gains.size()), factor(split.gains, 0.1), factor(split.gains, 0.5),
               factor(split.gains, 0.9), std::to_string(split.easy.size()), short_number(share_of(split.easy, 0.5)),
               short_number(share_of(split.allowed, 0.5))});
  }
  return any ? table.text() : "";
}

}  // namespace lrrt::bench
