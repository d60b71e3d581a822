// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "campaign.hpp"
#include "json.hpp"

namespace lrrt::bench {

/// One run of a plan document, as numbers; NaN for what it does not have.
struct PlanRecord {
  std::string query;  ///< map, query and seed: runs of two rows with the same text are a pair
  bool solved = false;
  double first = 0.0;                                   ///< milliseconds from the call to the first path
  double cost = 0.0;                                    ///< the same; where none was found, of the whole call
  double search = 0.0;                                  ///< the planner's share of it
  double prediction = 0.0;                              ///< the prediction's share: encode, infer, region
  double iterations = 0.0;                              ///< of the whole run
  double nodes = 0.0;                                   ///< of the whole run
  double checks = 0.0;                                  ///< motions checked in the whole run
  double clearance = 0.0;                               ///< mean along the last path, map units
  double cost_of_path = 0.0;                            ///< of the last path, map units
  double length = 0.0;                                  ///< the same, divided by the optimum
  std::array<double, within_percents.size()> within{};  ///< milliseconds to come so near to the optimum
};

/// All runs of one row on one group of maps.
struct RowRecords {
  std::string group;
  std::string planner;
  std::string baseline;  ///< name of the row that it is compared with
  bool guided = false;
  std::vector<PlanRecord> runs;
};

/// The runs of a plan document by group and row, in its order.
std::vector<RowRecords> records_of(const Json& document);

/// The rows of all groups together, by planner. @param records in the order in which rows shall come.
std::vector<RowRecords> over_all_groups(const std::vector<RowRecords>& records);

/// One field of the runs that have it.
std::vector<double> values_of(const std::vector<PlanRecord>& runs, double PlanRecord::*field);

/// Ratios of one field, the baseline's divided by the row's, over the pairs that both solved.
std::vector<double> paired_ratios(const std::vector<PlanRecord>& baseline, const std::vector<PlanRecord>& runs,
                                  double PlanRecord::*field);

}  // namespace lrrt::bench
