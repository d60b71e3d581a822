// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>

#include "json.hpp"

namespace lrrt::bench {

/// Whether a row has what a replay reads of it: its id and what came of it.
bool is_row(const Json& row);

/// Whether rows have what replays, reports, tables and logs read of them, each as the kind of suite has it.
class RowCheck {
 public:
  /// @param header what the rows share; with its suite.
  explicit RowCheck(const Json& header);

  bool operator()(const Json& row) const;

 private:
  bool is_plan_row(const Json& row) const;

  std::string kind_;                ///< of the suite; empty where the header has none
  std::set<std::string> planners_;  ///< names of the rows of a suite that plans
};

}  // namespace lrrt::bench
