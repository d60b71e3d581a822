// SPDX-License-Identifier: BSD-3-Clause
#include "plan_records.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace lrrt::bench {
namespace {

double number(const Json& row, const std::string& key) {
  const auto found = row.find(key);
  return found != row.end() && found->is_number() ? found->get<double>() : std::numeric_limits<double>::quiet_NaN();
}

PlanRecord record_of(const Json& row) {
  PlanRecord record;
  record.query =
      row.at("map").get<std::string>() + "\n" + row.at("query").get<std::string>() + "\n" + dumped(row.at("seed"));
  record.solved = row.at("solved").get<bool>();
  record.first = number(row, "first_ms");
  record.search = number(row, "search_ms");
  const Json& times = row.at("times_ms");
  record.cost = record.solved ? record.first : number(times, "total");
  record.prediction = number(times, "encode") + number(times, "infer") + number(times, "region");
  record.iterations = number(row, "iterations");
  record.nodes = number(row, "nodes");
  record.checks = number(row, "motion_checks");
  record.clearance = number(row.value("clearance", Json::object()), "mean");
  record.cost_of_path = number(row, "length");
  record.length = record.cost_of_path / number(row, "optimum");
  const Json within = row.value("within_ms", Json::object());
  for (std::size_t i = 0; i < within_percents.size(); ++i) {
    record.within[i] = number(within, std::to_string(within_percents[i]));
  }
  return record;
}

}  // namespace

std::vector<RowRecords> records_of(const Json& document) {
  std::map<std::string, const Json*> settings;
  for (const Json& planner : document.at("suite").at("planners")) {
    settings[planner.at("name").get<std::string>()] = &planner;
  }
  const auto suites = document.at("suite").at("baseline").get<std::string>();
  const auto begin = [&](const std::string& group, const std::string& planner) {
    const Json& said = *settings.at(planner);
    return RowRecords{group, planner, said.value("baseline", suites), said.at("strategy") != "uniform", {}};
  };
  std::vector<RowRecords> result;
  for (const Json& row : document.at("rows")) {
    const auto group = row.at("group").get<std::string>();
    const auto planner = row.at("planner").get<std::string>();
    const auto same = [&](const RowRecords& r) { return r.group == group && r.planner == planner; };
    auto place = std::find_if(result.begin(), result.end(), same);
    if (place == result.end()) place = result.insert(place, begin(group, planner));
    place->runs.push_back(record_of(row));
  }
  return result;
}

std::vector<RowRecords> over_all_groups(const std::vector<RowRecords>& records) {
  std::vector<RowRecords> result;
  for (const RowRecords& row : records) {
    const auto same = [&](const RowRecords& r) { return r.planner == row.planner; };
    const auto place = std::find_if(result.begin(), result.end(), same);
    if (place == result.end()) {
      result.push_back(row);
    } else {
      place->runs.insert(place->runs.end(), row.runs.begin(), row.runs.end());
    }
  }
  return result;
}

std::vector<double> values_of(const std::vector<PlanRecord>& runs, double PlanRecord::*field) {
  std::vector<double> values;
  for (const PlanRecord& run : runs) {
    if (run.solved && !std::isnan(run.*field)) values.push_back(run.*field);
  }
  return values;
}

std::vector<double> paired_ratios(const std::vector<PlanRecord>& baseline, const std::vector<PlanRecord>& runs,
                                  double PlanRecord::*field) {
  std::map<std::string, const PlanRecord*> by_query;
  for (const PlanRecord& run : baseline) by_query[run.query] = &run;
  std::vector<double> ratios;
  for (const PlanRecord& run : runs) {
    const auto pair = by_query.find(run.query);
    if (pair == by_query.end() || !run.solved || !pair->second->solved) continue;
    const double ratio = pair->second->*field / (run.*field);
    if (std::isfinite(ratio)) ratios.push_back(ratio);
  }
  return ratios;
}

}  // namespace lrrt::bench
