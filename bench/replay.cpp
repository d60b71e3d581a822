// SPDX-License-Identifier: BSD-3-Clause
#include "replay.hpp"

#include <algorithm>
#include <cstdlib>
#include <set>

#include "result_file.hpp"

namespace lrrt::bench {
namespace {

bool ended_by_clock(const Json& row) {
  return row.value("ended_by_clock", false);
}

/// False for a row that threads and the clock decide: no two runs of it are alike.
bool is_repeatable(const Json& row) {
  return row.value("repeatable", true);
}

bool same_run(const Json& before, const Json& after) {
  if (before.contains("area")) return before.at("area") == after.at("area");
  const auto count = [](const Json& row, const char* key) { return row.at(key).get<long long>(); };
  const long long slack = ended_by_clock(before) ? 1 : 0;
  return count(before, "iterations") == count(after, "iterations") &&
         std::llabs(count(before, "nodes") - count(after, "nodes")) <= slack;
}

std::string shown(const Json& row) {
  if (row.contains("area")) return dumped(row.at("area")) + " promising pixels";
  return dumped(row.at("iterations")) + " iterations, " + dumped(row.at("nodes")) + " nodes";
}

}  // namespace

Suite replayed_suite(const Json& document, const std::filesystem::path& file) {
  return parse_suite(dumped(document.at("suite")), file.string(), document.value("folder", std::string()));
}

IterationLimits replay_limits(const Json& document) {
  IterationLimits limits;
  for (const Json& row : document.at("rows")) {
    if (ended_by_clock(row)) limits[row.at("id").get<std::string>()] = row.at("iterations").get<std::size_t>();
  }
  return limits;
}

void keep_jobs_of(const Json& document, std::vector<Job>& jobs) {
  std::set<std::string> ids;
  for (const Json& row : document.at("rows")) ids.insert(row.at("id").get<std::string>());
  jobs.erase(std::remove_if(jobs.begin(), jobs.end(), [&](const Job& job) { return ids.count(job.id) == 0; }),
             jobs.end());
  if (jobs.size() == document.at("rows").size()) return;
  throw ResultError("the result has " + std::to_string(document.at("rows").size()) + " rows, of which " +
                    std::to_string(jobs.size()) + " can be run again: it was changed, or made by another version");
}

void check_inputs(const Json& document, const Json& inputs, const std::filesystem::path& file) {
  const Json before = document.value("inputs", Json::object());
  for (const auto& [kind, entries] : before.items()) {
    for (const auto& [name, what] : entries.items()) {
      const Json now = inputs.value(kind, Json::object()).value(name, Json());
      if (now == what) continue;
      throw ResultError(file.string() + ": " + kind + " '" + name + "' is no longer what it was (" + dumped(now) +
                        ", was " + dumped(what) + "): a replay needs the same files");
    }
  }
}

Comparison compare_replay(const Json& before, const Json& after) {
  constexpr int most_shown = 20;
  Comparison result;
  int different = 0;
  std::size_t rows = 0;
  for (std::size_t i = 0; i < before.at("rows").size(); ++i) {
    const Json& was = before.at("rows").at(i);
    const Json& is = after.at("rows").at(i);
    if (!is_repeatable(was)) continue;
    ++rows;
    if (same_run(was, is)) continue;
    if (++different > most_shown) continue;
    result.text += was.at("id").get<std::string>() + ": was " + shown(was) + ", is " + shown(is) + "\n";
  }
  result.same = different == 0;
  result.text += "replay: " + std::to_string(rows - static_cast<std::size_t>(different)) + " of " +
                 std::to_string(rows) + " rows are the same\n";
  const std::size_t left_out = before.at("rows").size() - rows;
  if (left_out > 0) result.text += std::to_string(left_out) + " rows, which no run repeats, were not compared\n";
  return result;
}

}  // namespace lrrt::bench
