// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>

#include "number_rules.hpp"
#include "suite.hpp"

namespace lrrt::bench {
namespace {

/// The robot's outline: its corners, or a rectangle.
std::optional<Polygon> read_outline(const Fields& fields) {
  constexpr const char* rectangle = "[length, width, distance from the rear edge to the reference point] in map units";
  if (!fields.has("outline") && !fields.has("rectangle")) return std::nullopt;
  if (fields.has("outline") && fields.has("rectangle")) fields.refuse("rectangle", "either 'outline' or 'rectangle'");
  const char* key = fields.has("outline") ? "outline" : "rectangle";
  try {
    if (fields.has("outline")) return Polygon(fields.points("outline"));
    const std::vector<double> numbers = fields.numbers("rectangle", {}, {0, endless, rectangle});
    if (numbers.size() != 3) fields.refuse("rectangle", rectangle);
    return Polygon::rectangle(numbers[0], numbers[1], numbers[2]);
  } catch (const RequestError& error) {
    fields.refuse(key, std::string("a simple polygon (") + error.what() + ")");
  }
}

/// The exact shortest path is that of a point or a disc.
bool read_reference(const Fields& fields, bool headings) {
  const bool wanted = fields.flag("reference", !headings);
  if (wanted && headings) {
    fields.refuse("reference", "false: the exact shortest path is known in the plane only, and a row has a 'motion'");
  }
  return wanted;
}

/// Whether a car can drive from start to goal is asked for the robot of a row.
void check_drivable(const Fields& fields, const PlanSuite& suite) {
  const auto known = [&](const std::string& motion) {
    return suite.outline &&
           std::any_of(suite.rows.begin(), suite.rows.end(), [&](const PlanRow& row) { return row.motion == motion; });
  };
  for (const MapSource& source : suite.maps) {
    for (const QuerySource& query : source.queries) {
      if (query.drivable.empty() || known(query.drivable)) continue;
      fields.refuse_all("'drivable: " + query.drivable + "' of '" + source.name +
                        "': expected an outline and a row with that motion");
    }
  }
}

}  // namespace

PlanSuite read_plan_suite(const Fields& fields) {
  std::vector<std::string> known = {"kind",    "title",     "maps",   "queries",   "planners", "baseline",
                                    "runs",    "seed",      "radius", "rectangle", "outline",  "unknown",
                                    "threads", "reference", "move",   "obstacle"};
  known.insert(known.end(), row_keys().begin(), row_keys().end());
  fields.allow_only(known);
  PlanSuite suite;
  suite.radius = fields.number("radius", suite.radius, lengths);
  suite.outline = read_outline(fields);
  suite.move = fields.number("move", suite.move, lengths);
  suite.obstacle = fields.number("obstacle", suite.obstacle, lengths);
  fields.require("maps", "a list of maps");
  suite.rows = read_plan_rows(fields, suite);
  suite.maps = read_map_sources(fields, suite.has_headings());
  check_drivable(fields, suite);
  std::vector<std::string> names;
  for (const PlanRow& row : suite.rows) names.push_back(row.name);
  suite.baseline = fields.word("baseline", names.front(), names);
  suite.runs = static_cast<int>(fields.count("runs", suite.runs, counts));
  suite.seed = fields.seed("seed", suite.seed);
  suite.unknown =
      fields.word("unknown", "occupied", {"occupied", "free"}) == "free" ? UnknownIs::free : UnknownIs::occupied;
  suite.threads = static_cast<int>(fields.count("threads", suite.threads, {0, 1024, "0 (choose) to 1024 threads"}));
  suite.reference = read_reference(fields, suite.has_headings());
  return suite;
}

}  // namespace lrrt::bench
