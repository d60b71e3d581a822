// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <sstream>

#include "campaign.hpp"
#include "hard_queries.hpp"
#include "plan_records.hpp"
#include "statistics.hpp"
#include "table.hpp"

namespace lrrt::bench {
namespace {

using Field = double PlanRecord::*;

std::string median_and_quartiles(const std::vector<double>& values, const char* unit = "") {
  if (values.empty()) return "-";
  const Summary s = summarize(values);
  return short_number(s.median) + unit + " [" + short_number(s.lower) + ", " + short_number(s.upper) + "]";
}

std::string mean_and_deviation(const std::vector<double>& values) {
  if (values.empty()) return "-";
  const Summary s = summarize(values);
  return short_number(s.mean) + " ± " + short_number(s.deviation);
}

std::string percent(double share) {
  return fixed_number(100.0 * share, 0);
}

std::string success(const std::vector<PlanRecord>& runs) {
  const auto solved =
      static_cast<std::size_t>(std::count_if(runs.begin(), runs.end(), [](const PlanRecord& r) { return r.solved; }));
  const Interval interval = wilson_interval(solved, runs.size());
  return std::to_string(solved) + "/" + std::to_string(runs.size()) + " (" + percent(interval.low) + " to " +
         percent(interval.high) + " %)";
}

std::string medians_table(const std::vector<const RowRecords*>& rows) {
  Table table({"median [quartiles]", "solved (95 %)", "first path, ms", "prediction", "search", "iterations", "nodes",
               "length"});
  for (const RowRecords* row : rows) {
    const auto cell = [&](Field field) { return median_and_quartiles(values_of(row->runs, field)); };
    table.add({row->planner, success(row->runs), cell(&PlanRecord::first), cell(&PlanRecord::prediction),
               cell(&PlanRecord::search), cell(&PlanRecord::iterations), cell(&PlanRecord::nodes),
               median_and_quartiles(values_of(row->runs, &PlanRecord::length))});
  }
  return table.text();
}

std::string means_table(const std::vector<const RowRecords*>& rows) {
  Table table(
      {"mean ± deviation", "first path, ms", "search", "iterations", "nodes", "motion checks", "length", "clearance"});
  for (const RowRecords* row : rows) {
    const auto cell = [&](Field field) { return mean_and_deviation(values_of(row->runs, field)); };
    table.add({row->planner, cell(&PlanRecord::first), cell(&PlanRecord::search), cell(&PlanRecord::iterations),
               cell(&PlanRecord::nodes), cell(&PlanRecord::checks), cell(&PlanRecord::length),
               cell(&PlanRecord::clearance)});
  }
  return table.text();
}

/// Median time to come near the optimum, and how many of the runs did; empty when none of any row did.
std::string within_table(const std::vector<const RowRecords*>& rows) {
  std::vector<std::string> header{"to the optimum, ms"};
  for (const int percents : within_percents) header.push_back("within " + std::to_string(percents) + " %");
  Table table(header);
  bool any = false;
  for (const RowRecords* row : rows) {
    std::vector<std::string> cells{row->planner};
    for (std::size_t i = 0; i < within_percents.size(); ++i) {
      std::vector<double> times;
      for (const PlanRecord& run : row->runs) {
        if (!std::isnan(run.within[i])) times.push_back(run.within[i]);
      }
      any = any || !times.empty();
      cells.push_back(short_number(summarize(times).median) + " (" + std::to_string(times.size()) + "/" +
                      std::to_string(row->runs.size()) + ")");
    }
    table.add(std::move(cells));
  }
  return any ? table.text() : "";
}

std::string gains_table(const std::vector<const RowRecords*>& rows, const RowRecords& baseline) {
  Table table({"gain over " + baseline.planner, "pairs", "first path", "search", "iterations", "nodes", "length"});
  for (const RowRecords* row : rows) {
    if (row == &baseline || row->baseline != baseline.planner) continue;
    const auto ratios = [&](Field field) { return paired_ratios(baseline.runs, row->runs, field); };
    const auto cell = [&](Field field) { return median_and_quartiles(ratios(field), "×"); };
    table.add({row->planner, std::to_string(ratios(&PlanRecord::first).size()), cell(&PlanRecord::first),
               cell(&PlanRecord::search), cell(&PlanRecord::iterations), cell(&PlanRecord::nodes),
               cell(&PlanRecord::cost_of_path)});
  }
  return table.text();
}

/// A table of gains for every row that others are compared with.
std::string gains_tables(const std::vector<const RowRecords*>& rows) {
  std::string text;
  for (const RowRecords* baseline : rows) {
    const auto compared = [&](const RowRecords* r) { return r != baseline && r->baseline == baseline->planner; };
    if (std::any_of(rows.begin(), rows.end(), compared)) text += "\n" + gains_table(rows, *baseline);
  }
  return text;
}

std::string group_report(const std::vector<const RowRecords*>& rows) {
  std::string text = "== " + rows.front()->group + "\n\n" + medians_table(rows) + "\n" + means_table(rows);
  for (const std::string& table : {within_table(rows), hard_table(rows)}) {
    if (!table.empty()) text += "\n" + table;
  }
  return text + gains_tables(rows) + "\n";
}

/// What all groups say together: hard and easy queries.
std::string overall_report(const std::vector<RowRecords>& records) {
  const std::vector<RowRecords> all = over_all_groups(records);
  std::vector<const RowRecords*> rows(all.size());
  std::transform(all.begin(), all.end(), rows.begin(), [](const RowRecords& row) { return &row; });
  const std::string table = all.size() < records.size() ? hard_table(rows) : "";
  return table.empty() ? "" : "== all groups\n\n" + table + "\n";
}

}  // namespace

std::string plan_report(const Json& document) {
  const std::vector<RowRecords> records = records_of(document);
  std::string text;
  std::vector<const RowRecords*> rows;
  for (std::size_t i = 0; i < records.size(); ++i) {
    rows.push_back(&records[i]);
    const bool last = i + 1 == records.size() || records[i + 1].group != records[i].group;
    if (!last) continue;
    text += group_report(rows);
    rows.clear();
  }
  return text + overall_report(records) +
         "Times, lengths, iterations and nodes are of solved runs. --help says what the columns mean.\n";
}

std::string plan_csv(const Json& document) {
  std::ostringstream text;
  text << "group,map,query,planner,seed,status,iterations,nodes,first_ms,search_ms,first_iteration,first_length,length,"
          "optimum,motion_checks,least_clearance,mean_clearance,prepare_ms,encode_ms,infer_ms,region_ms,plan_ms,total_"
          "ms";
  for (const int percents : within_percents) text << ",within_" << percents << "_ms";
  text << '\n';
  const auto add = [&](const Json& row, const char* key) {
    const auto value = row.find(key);
    text << ',';
    if (value != row.end() && !value->is_null()) text << dumped(*value);
  };
  for (const Json& row : document.at("rows")) {
    text << quoted(row.at("group").get<std::string>());
    for (const char* key : {"map", "query", "planner"}) text << ',' << quoted(row.at(key).get<std::string>());
    text << ',' << row.at("seed") << ',' << row.at("status").get<std::string>();
    for (const char* key : {"iterations", "nodes", "first_ms", "search_ms", "first_iteration", "first_length", "length",
                            "optimum", "motion_checks"}) {
      add(row, key);
    }
    for (const char* key : {"least", "mean"}) add(row.value("clearance", Json::object()), key);
    for (const char* key : {"prepare", "encode", "infer", "region", "plan", "total"}) add(row.at("times_ms"), key);
    const Json within = row.value("within_ms", Json::object());
    for (const int percents : within_percents) add(within, std::to_string(percents).c_str());
    text << '\n';
  }
  return text.str();
}

}  // namespace lrrt::bench
