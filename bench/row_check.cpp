// SPDX-License-Identifier: BSD-3-Clause
#include "row_check.hpp"

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <limits>

namespace lrrt::bench {
namespace {

Json field(const Json& json, const char* key) {
  return json.is_object() ? json.value(key, Json()) : Json();
}

bool is_count(const Json& value) {
  return value.is_number_integer() && value >= 0 && value <= std::numeric_limits<std::int64_t>::max();
}

bool is_side(const Json& value) {
  return is_count(value) && value <= std::numeric_limits<int>::max();
}

bool is_flag_or_missing(const Json& row, const char* key) {
  return row.find(key) == row.end() || row.at(key).is_boolean();
}

template <typename Rule>
bool all_fields(const Json& json, std::initializer_list<const char*> keys, const Rule& rule) {
  return std::all_of(keys.begin(), keys.end(), [&](const char* key) { return rule(field(json, key)); });
}

/// A list of lists of so many numbers each.
bool is_table(const Json& json, std::size_t columns) {
  const auto is_line = [&](const Json& line) {
    return line.is_array() && line.size() == columns &&
           std::all_of(line.begin(), line.end(), [](const Json& value) { return value.is_number(); });
  };
  return json.is_array() && std::all_of(json.begin(), json.end(), is_line);
}

bool is_text(const Json& value) {
  return value.is_string();
}

bool is_number(const Json& value) {
  return value.is_number();
}

bool is_predict_row(const Json& row) {
  const Json sides = field(row, "input_sides");
  return all_fields(row, {"model", "name"}, is_text) &&
         all_fields(row, {"input_size", "size", "threads", "batch"}, is_side) && is_count(field(row, "area")) &&
         field(row, "spinning").is_boolean() && sides.is_array() && std::all_of(sides.begin(), sides.end(), is_side) &&
         is_table(field(row, "times"), 4) && !row.at("times").empty();
}

}  // namespace

bool is_row(const Json& row) {
  return field(row, "id").is_string() && is_flag_or_missing(row, "ended_by_clock") &&
         is_flag_or_missing(row, "repeatable") &&
         (is_count(field(row, "area")) || all_fields(row, {"iterations", "nodes"}, is_count));
}

RowCheck::RowCheck(const Json& header) {
  const Json suite = field(header, "suite");
  const Json kind = field(suite, "kind");
  if (kind.is_string()) kind_ = kind.get<std::string>();
  for (const Json& planner : field(suite, "planners")) {
    const Json name = field(planner, "name");
    if (name.is_string()) planners_.insert(name.get<std::string>());
  }
}

bool RowCheck::operator()(const Json& row) const {
  return is_row(row) && (kind_ != "plan" || is_plan_row(row)) && (kind_ != "predict" || is_predict_row(row));
}

bool RowCheck::is_plan_row(const Json& row) const {
  const Json times = field(row, "times_ms");
  const Json history = field(row, "history");
  return all_fields(row, {"group", "map", "query", "planner", "status"}, is_text) &&
         planners_.count(row.at("planner").get<std::string>()) != 0 &&
         all_fields(row, {"iterations", "nodes", "seed"}, [](const Json& v) { return v.is_number_integer(); }) &&
         field(row, "solved").is_boolean() &&
         all_fields(times, {"prepare", "encode", "infer", "region", "plan", "total"}, is_number) &&
         (history.is_null() || is_table(history, 3));
}

}  // namespace lrrt::bench
