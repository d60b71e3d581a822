// SPDX-License-Identifier: BSD-3-Clause
#include "ompl_log.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <sstream>
#include <vector>

#include "lrrt/plan.hpp"

namespace lrrt::bench {
namespace {

constexpr std::array<PlanStatus, 9> statuses = {
    PlanStatus::solved,         PlanStatus::start_outside,   PlanStatus::goal_outside,
    PlanStatus::start_occupied, PlanStatus::goal_occupied,   PlanStatus::not_connected,
    PlanStatus::time_limit,     PlanStatus::iteration_limit, PlanStatus::cancelled};

/// Properties of a run, in the order in which run_line() writes them. Times are seconds there.
constexpr std::array<const char*, 14> run_properties = {"solved BOOLEAN",
                                                        "status ENUM",
                                                        "time REAL",
                                                        "time to first solution REAL",
                                                        "prediction time REAL",
                                                        "iterations INTEGER",
                                                        "graph states INTEGER",
                                                        "best cost REAL",
                                                        "first cost REAL",
                                                        "optimal cost REAL",
                                                        "motion checks INTEGER",
                                                        "clearance REAL",
                                                        "memory REAL",
                                                        "seed INTEGER"};

/// Runs of one row.
struct LoggedPlanner {
  std::string name;
  std::vector<const Json*> runs;
};

std::vector<LoggedPlanner> planners_of(const Json& document) {
  std::set<std::string> groups;
  for (const Json& row : document.at("rows")) groups.insert(row.at("group").get<std::string>());
  std::vector<LoggedPlanner> planners;
  for (const Json& row : document.at("rows")) {
    std::string name = row.at("planner").get<std::string>();
    if (groups.size() > 1) name += " @ " + row.at("group").get<std::string>();
    const auto same = [&](const LoggedPlanner& p) { return p.name == name; };
    auto place = std::find_if(planners.begin(), planners.end(), same);
    if (place == planners.end()) place = planners.insert(place, {name, {}});
    place->runs.push_back(&row);
  }
  return planners;
}

/// A number, divided; nothing where the row has none: the parser reads that as NULL.
std::string number(const Json& row, const char* key, double divisor = 1.0) {
  const auto value = row.find(key);
  if (value == row.end() || !value->is_number()) return "";
  std::ostringstream text;
  text << value->get<double>() / divisor;
  return text.str();
}

std::size_t status_number(const Json& row) {
  const auto word = row.at("status").get<std::string>();
  const auto place = std::find_if(statuses.begin(), statuses.end(), [&](PlanStatus s) { return word == to_string(s); });
  return static_cast<std::size_t>(place - statuses.begin());
}

std::string run_line(const Json& row) {
  const Json& times = row.at("times_ms");
  const double prediction =
      times.at("encode").get<double>() + times.at("infer").get<double>() + times.at("region").get<double>();
  std::ostringstream text;
  text << row.at("solved").get<bool>() << "; " << status_number(row) << "; " << number(times, "total", 1e3) << "; "
       << number(row, "first_ms", 1e3) << "; " << prediction / 1e3 << "; " << row.at("iterations") << "; "
       << row.at("nodes") << "; " << number(row, "length") << "; " << number(row, "first_length") << "; "
       << number(row, "optimum") << "; " << dumped(row.value("motion_checks", Json(0))) << "; "
       << number(row.value("clearance", Json::object()), "mean") << "; ; " << row.at("seed") << "; ";
  return text.str();
}

/// Cost over time: "time,cost,;" for every better path.
std::string progress_line(const Json& row) {
  std::ostringstream text;
  for (const Json& step : row.value("history", Json::array())) {
    text << step.at(0).get<double>() / 1e3 << ',' << step.at(1) << ',' << step.at(2).get<double>() << ",;";
  }
  return text.str();
}

/// The settings of a planner, as "name = value" lines.
std::vector<std::string> settings_of(const Json& document, const std::string& name) {
  std::vector<std::string> lines;
  for (const Json& row : document.at("suite").at("planners")) {
    if (row.at("name") != name) continue;
    for (const auto& [key, value] : row.items()) {
      if (key != "name") lines.push_back(key + " = " + (value.is_string() ? value.get<std::string>() : dumped(value)));
    }
  }
  return lines;
}

void write_planner(std::ostream& out, const Json& document, const LoggedPlanner& planner) {
  out << planner.name << '\n';
  const std::vector<std::string> settings =
      settings_of(document, planner.runs.front()->at("planner").get<std::string>());
  out << settings.size() << " common properties\n";
  for (const std::string& line : settings) out << line << '\n';
  out << run_properties.size() << " properties for each run\n";
  for (const char* property : run_properties) out << property << '\n';
  out << planner.runs.size() << " runs\n";
  for (const Json* run : planner.runs) out << run_line(*run) << '\n';
  out << "3 progress properties for each run\ntime REAL\niterations INTEGER\nbest cost REAL\n";
  out << planner.runs.size() << " runs\n";
  for (const Json* run : planner.runs) out << progress_line(*run) << '\n';
  out << ".\n";
}

/// The parser takes the last word of some lines, so they must not hold spaces.
std::string one_word(std::string text) {
  std::replace(text.begin(), text.end(), ' ', '_');
  return text.empty() ? "lrrt_bench" : text;
}

double total_seconds(const Json& document) {
  double sum = 0.0;
  for (const Json& row : document.at("rows")) sum += row.at("times_ms").at("total").get<double>();
  return sum / 1e3;
}

double longest_limit(const Json& suite) {
  double limit = 0.0;
  for (const Json& row : suite.at("planners")) limit = std::max(limit, row.at("time_limit").get<double>());
  return limit;
}

}  // namespace

std::string ompl_log(const Json& document) {
  const Json& suite = document.at("suite");
  const Json& machine = document.at("machine");
  const std::vector<LoggedPlanner> planners = planners_of(document);
  std::size_t most_runs = 0;
  for (const LoggedPlanner& planner : planners) most_runs = std::max(most_runs, planner.runs.size());
  std::ostringstream out;
  out << "OMPL version " << document.at("versions").at("ompl").get<std::string>() << '\n'
      << "Experiment " << one_word(suite.value("title", std::string())) << '\n'
      << "Running on " << one_word(machine.at("processor").get<std::string>()) << '\n'
      << "Starting at " << document.value("started", std::string("1970-01-01 00:00:00")) << '\n'
      << "<<<|\n"
      << dumped(suite, 1) << "\n|>>>\n"
      << "<<<|\n"
      << dumped(machine, 1) << "\n|>>>\n"
      << suite.at("seed") << " is the random seed\n"
      << longest_limit(suite) << " seconds per run\n"
      << "0 MB per run\n"
      << most_runs << " runs per planner\n"
      << total_seconds(document) << " seconds spent to collect the data\n"
      << "1 enum type\nstatus";
  for (const PlanStatus status : statuses) out << '|' << to_string(status);
  out << '\n' << planners.size() << " planners\n";
  for (const LoggedPlanner& planner : planners) write_planner(out, document, planner);
  return out.str();
}

}  // namespace lrrt::bench
