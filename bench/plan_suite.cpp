// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>
#include <sstream>

#include "grid_search.hpp"
#include "lrrt/planner.hpp"
#include "maze.hpp"
#include "suite.hpp"

namespace lrrt::bench {
namespace {

constexpr double endless = std::numeric_limits<double>::max();
constexpr NumberRule any_number{-endless, endless, "a number"};
constexpr NumberRule counts{1, 1e6, "a whole number from 1 to 1000000"};
constexpr NumberRule counts_or_all{0, 1e6, "0 (all) or a whole number up to 1000000"};
constexpr NumberRule counts_or_zero{0, 1e15, "a whole number from 0 on"};
constexpr NumberRule levels{5, 2047, "an odd number of blocks from 5 on"};
constexpr NumberRule sides{5, 16384, "a side from 5 to 16384 pixels, at least one a block"};
constexpr NumberRule shares{0, 1, "a share from 0 to 1"};
constexpr NumberRule lengths{0, endless, "0 or a positive length in map units"};
constexpr NumberRule factors{1, endless, "a factor from 1 on"};

const std::vector<std::string> row_keys = {"planner",     "strategy",   "alpha",           "model",
                                           "range",       "goal_bias",  "goal_tolerance",  "stop",
                                           "cost_factor", "time_limit", "iteration_limit", "neighbors"};

/// Stands in for a model while options are checked.
class NoPredictor final : public RegionPredictor {
  Prediction predict(const OccupancyMap&, const Eigen::Vector2d&, const Eigen::Vector2d&) const override {
    throw ModelError("this predictor predicts nothing");
  }
};

std::string words(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

Eigen::Vector2d point(const Fields& fields, const std::string& key) {
  fields.require(key, "two numbers [x, y] in map units");
  const std::vector<double> numbers = fields.numbers(key, {}, any_number);
  if (numbers.size() != 2) fields.refuse(key, "two numbers [x, y] in map units");
  return {numbers[0], numbers[1]};
}

QuerySource read_query(const Fields& fields) {
  const std::string kind = fields.word("kind", "", {"farthest", "random", "points", "scen"});
  QuerySource query;
  if (kind == "farthest") {
    fields.allow_only({"kind"});
  } else if (kind == "random") {
    fields.allow_only({"kind", "count", "apart", "seed"});
    query.kind = QuerySource::Kind::random;
    query.count = static_cast<int>(fields.count("count", query.count, counts));
    query.apart = fields.number("apart", query.apart, shares);
    query.seed = fields.seed("seed", query.seed);
  } else if (kind == "points") {
    fields.allow_only({"kind", "start", "goal"});
    query.kind = QuerySource::Kind::points;
    query.start = point(fields, "start");
    query.goal = point(fields, "goal");
  } else {
    fields.allow_only({"kind", "path", "count"});
    query.kind = QuerySource::Kind::scen;
    query.path = fields.text("path", "");
    query.count = static_cast<int>(fields.count("count", 0, counts_or_all));
  }
  return query;
}

std::vector<QuerySource> read_queries(const Fields& fields, const std::vector<QuerySource>& fallback) {
  if (!fields.has("queries")) return fallback;
  std::vector<QuerySource> result;
  for (const Fields& child : fields.children("queries")) result.push_back(read_query(child));
  return result;
}

MapSource read_maze(const Fields& fields) {
  fields.allow_only({"kind", "name", "level", "algorithm", "count", "pixels", "braid", "seed", "queries"});
  MapSource source;
  source.level = static_cast<int>(fields.count("level", source.level, levels));
  if (source.level % 2 == 0) fields.refuse("level", levels.expected);
  source.algorithms = fields.texts("algorithm", source.algorithms);
  const std::vector<std::string>& known = maze_algorithm_names();
  for (const std::string& name : source.algorithms) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      fields.refuse("algorithm", "dfs, prim, wilson, or a list of such");
    }
  }
  source.count = static_cast<int>(fields.count("count", source.count, counts));
  source.pixels = static_cast<int>(fields.count("pixels", source.pixels, sides));
  if (source.pixels < source.level) fields.refuse("pixels", sides.expected);
  check_pixels(fields, "count", source.count, source.pixels);
  source.braid = fields.number("braid", source.braid, shares);
  source.seed = fields.seed("seed", source.seed);
  const std::string level = std::to_string(source.level);
  source.name = "mazes of " + level + "×" + level + " blocks on " + std::to_string(source.pixels) + " pixels";
  return source;
}

MapSource read_map_source(const Fields& fields, const std::vector<QuerySource>& queries) {
  const std::string kind = fields.word("kind", "", {"maze", "file", "folder"});
  MapSource source;
  if (kind == "maze") {
    source = read_maze(fields);
  } else {
    fields.allow_only({"kind", "name", "path", "queries"});
    source.kind = kind == "file" ? MapSource::Kind::file : MapSource::Kind::folder;
    fields.require("path", "a path, relative to the suite's folder");
    source.path = source.name = fields.text("path", "");
  }
  source.name = fields.text("name", source.name);
  source.queries = read_queries(fields, queries);
  if (source.queries.empty()) fields.refuse_all("no queries: expected a list 'queries' here or at the top of the file");
  return source;
}

/// The name of a row that has none, or a part of a list: what sets it apart.
std::string name_of(const Fields& fields, const PlanRow& row) {
  const bool guided = row.strategy != "uniform";
  std::string name = fields.text("name", row.options.planner);
  if (!fields.has("name") && guided) name += " " + row.strategy;
  const auto add = [&](const char* key, const std::string& value) {
    const bool several = fields.has("name") && fields.is_list(key);
    if (several) name += ", " + value;
  };
  add("planner", row.options.planner);
  add("strategy", row.strategy);
  if (guided && (fields.is_list("alpha") || !fields.has("name"))) name += ", α " + words(row.options.alpha);
  if (fields.is_list("model")) name += ", " + row.model;
  if (fields.is_list("range")) name += ", range " + words(row.options.range);
  return name;
}

/// Asks the library whether the options make sense.
void check(const Fields& fields, const PlanRow& row) {
  if (row.options.planner == grid_search_name) {
    if (row.strategy != "uniform" || row.stop != "first") {
      fields.refuse_all(std::string(grid_search_name) +
                        " searches the grid: expected 'strategy: uniform' and 'stop: first'");
    }
    return;
  }
  try {
    Planner(std::make_shared<NoPredictor>(), row.options);
  } catch (const RequestError& error) {
    fields.refuse_all(error.what());
  }
}

template <typename Function>
auto checked_word(const Fields& fields, const char* key, const std::string& word, Function&& function) {
  try {
    return function(word);
  } catch (const RequestError& error) {
    fields.refuse_all(std::string(key) + ": " + error.what());
  }
}

/// The settings that take one value each; those that may be lists are filled in by expanded().
PlanRow read_common(const Fields& fields, const PlanRow& fallback) {
  PlanRow row = fallback;
  PlanOptions& o = row.options;
  o.goal_bias = fields.number("goal_bias", o.goal_bias, shares);
  o.goal_tolerance = fields.number("goal_tolerance", o.goal_tolerance, lengths);
  row.stop = fields.text("stop", row.stop);
  o.stop = checked_word(fields, "stop", row.stop, stop_from_string);
  row.neighbors = fields.text("neighbors", row.neighbors);
  o.neighbors = checked_word(fields, "neighbors", row.neighbors, neighbors_from_string);
  o.cost_factor = fields.number("cost_factor", o.cost_factor, factors);
  o.time_limit = fields.number("time_limit", o.time_limit, time_limits);
  const std::int64_t limit = fields.count("iteration_limit", -1, counts_or_zero);
  if (limit == 0) o.iteration_limit = std::numeric_limits<std::size_t>::max();
  if (limit > 0) o.iteration_limit = static_cast<std::size_t>(limit);
  return row;
}

/// One row for every combination of the values in lists. An unguided row has no α and no model to combine.
std::vector<PlanRow> expanded(const Fields& fields, const PlanRow& fallback) {
  const PlanRow common = read_common(fields, fallback);
  const PlanOptions& o = common.options;
  const std::vector<double> alphas = fields.numbers("alpha", {o.alpha}, shares);
  const std::vector<std::string> models = fields.texts("model", {common.model});
  std::vector<PlanRow> rows;
  for (const std::string& planner : fields.texts("planner", {o.planner})) {
    for (const std::string& strategy : fields.texts("strategy", {common.strategy})) {
      const bool guided = strategy != "uniform";
      for (const double range : fields.numbers("range", {o.range}, lengths)) {
        for (std::size_t m = 0; m < (guided ? models.size() : 1); ++m) {
          for (std::size_t a = 0; a < (guided ? alphas.size() : 1); ++a) {
            PlanRow row = common;
            row.options.planner = planner;
            row.strategy = strategy;
            row.options.strategy = checked_word(fields, "strategy", strategy, strategy_from_string);
            row.options.range = range;
            row.model = models[m];
            row.options.alpha = alphas[a];
            rows.push_back(row);
          }
        }
      }
    }
  }
  return rows;
}

std::vector<PlanRow> read_rows(const Fields& fields) {
  fields.require("planners", "a list of planners, each a row of the report");
  for (const std::string& key : row_keys) {
    if (fields.is_list(key)) fields.refuse(key, "one value; a list belongs to an entry of 'planners'");
  }
  PlanRow fallback = expanded(fields, {}).front();
  std::vector<PlanRow> rows;
  std::vector<std::string> known = row_keys;
  known.emplace_back("name");
  for (const Fields& child : fields.children("planners")) {
    child.allow_only(known);
    for (PlanRow& row : expanded(child, fallback)) {
      row.name = name_of(child, row);
      check(child, row);
      const bool taken = std::any_of(rows.begin(), rows.end(), [&](const PlanRow& r) { return r.name == row.name; });
      if (taken) child.refuse_all("a second row is called '" + row.name + "': expected a 'name' of its own");
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace

PlanSuite read_plan_suite(const Fields& fields) {
  std::vector<std::string> known = {"kind", "title", "maps",   "queries", "planners", "baseline",
                                    "runs", "seed",  "radius", "unknown", "threads",  "reference"};
  known.insert(known.end(), row_keys.begin(), row_keys.end());
  fields.allow_only(known);
  PlanSuite suite;
  fields.require("maps", "a list of maps");
  const std::vector<QuerySource> queries = read_queries(fields, {});
  for (const Fields& child : fields.children("maps")) {
    suite.maps.push_back(read_map_source(child, queries));
    const auto same = [&](const MapSource& other) { return other.name == suite.maps.back().name; };
    if (std::count_if(suite.maps.begin(), suite.maps.end(), same) > 1) {
      child.refuse_all("a second entry is called '" + suite.maps.back().name + "': expected a 'name' of its own");
    }
  }
  suite.rows = read_rows(fields);
  std::vector<std::string> names;
  for (const PlanRow& row : suite.rows) names.push_back(row.name);
  suite.baseline = fields.word("baseline", names.front(), names);
  suite.runs = static_cast<int>(fields.count("runs", suite.runs, counts));
  suite.seed = fields.seed("seed", suite.seed);
  suite.radius = fields.number("radius", suite.radius, lengths);
  suite.unknown =
      fields.word("unknown", "occupied", {"occupied", "free"}) == "free" ? UnknownIs::free : UnknownIs::occupied;
  suite.threads = static_cast<int>(fields.count("threads", suite.threads, {0, 1024, "0 (choose) to 1024 threads"}));
  suite.reference = fields.flag("reference", suite.reference);
  return suite;
}

}  // namespace lrrt::bench
