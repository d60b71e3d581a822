// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <sstream>

#include "grid_search.hpp"
#include "hybrid_search.hpp"
#include "lrrt/planner.hpp"
#include "number_rules.hpp"
#include "portfolio.hpp"
#include "suite.hpp"

namespace lrrt::bench {
namespace {

/// Every row is held in memory, and is a line of the report.
constexpr std::size_t most_rows = 10'000;
constexpr NumberRule counts_or_zero{0, 1e15, "a whole number from 0 on"};
constexpr NumberRule factors{1, endless, "a factor from 1 on"};
constexpr NumberRule details{0, 16384, "a side from 1 to 16384 pixels, or 0 to leave it to the model"};

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
  if (guided && fields.is_list("detail")) name += ", detail " + std::to_string(row.detail);
  if (fields.is_list("range")) name += ", range " + words(row.options.range);
  return name;
}

/// A* takes a point through the plane to its first path, unguided.
void check_grid_search(const Fields& fields, const PlanRow& row, const PlanSuite& robot) {
  if (row.strategy == "uniform" && row.stop == "first" && !row.has_heading() && !robot.outline) return;
  fields.refuse_all(std::string(grid_search_name) +
                    " searches the grid: expected 'strategy: uniform', 'stop: first', 'motion: plane' and no outline");
}

/// Hybrid A* takes a car with an outline to its first path, unguided.
void check_hybrid_search(const Fields& fields, const PlanRow& row, const PlanSuite& robot) {
  const bool car = row.motion == "dubins" || row.motion == "reeds_shepp";
  if (row.strategy == "uniform" && row.stop == "first" && car && row.turning_radius > 0.0 && robot.outline) return;
  fields.refuse_all(std::string(hybrid_search_name) +
                    " searches a grid of poses: expected 'strategy: uniform', 'stop: first', 'motion: dubins' or "
                    "'reeds_shepp', a turning_radius and an outline");
}

/// OMPL's hybrid puts together pieces of paths both ways, and is not guided.
void check_portfolio(const Fields& fields, const PlanRow& row, const PlanSuite& robot) {
  const bool body = row.motion == "turning" || (row.motion == "reeds_shepp" && row.turning_radius > 0.0);
  const bool able = row.motion == "plane" ? !robot.outline : body && robot.outline;
  if (row.strategy == "uniform" && row.stop == "first" && able) return;
  fields.refuse_all(
      std::string(portfolio_name) +
      " is OMPL's own: expected 'strategy: uniform', 'stop: first', and 'motion: plane' without an outline, "
      "or 'turning', or 'reeds_shepp' and a turning_radius, with one");
}

/// Whether a row is no planner of the library's, and then whether it makes sense.
bool check_rival(const Fields& fields, const PlanRow& row, const PlanSuite& robot) {
  const std::string& name = row.options.planner;
  if (name == grid_search_name) check_grid_search(fields, row, robot);
  if (name == hybrid_search_name) check_hybrid_search(fields, row, robot);
  if (name == portfolio_name) check_portfolio(fields, row, robot);
  const bool rival = name == grid_search_name || name == hybrid_search_name || name == portfolio_name;
  if (rival && (!row.after.empty() || row.options.simplify || row.options.goal_tolerance > 0.0)) {
    fields.refuse_all(name + " plans once, to the goal itself: expected no 'after', 'simplify' and 'goal_tolerance'");
  }
  return rival;
}

/// Asks the library whether options and robot make sense, with a map on which no query gets beyond that.
void check(const Fields& fields, const PlanRow& row, const PlanSuite& robot) {
  if (row.session && row.after.empty()) fields.refuse("session", "'after: move' or 'after: obstacle' with it");
  if (check_rival(fields, row, robot)) return;
  const OccupancyMap closed(1, 1, {Cell::occupied});
  PlanRequest request{closed, {0.5, 0.5}, {0.5, 0.5}};
  request.outline = robot.outline;
  request.motion = motion_from_string(row.motion);
  request.turning_radius = row.turning_radius;
  try {
    Planner(std::make_shared<NoPredictor>(), row.options).plan(request);
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
  row.motion = fields.text("motion", row.motion);
  checked_word(fields, "motion", row.motion, motion_from_string);
  row.turning_radius = fields.number("turning_radius", row.turning_radius, lengths);
  row.baseline = fields.text("baseline", row.baseline);
  if (fields.has("after")) row.after = fields.word("after", "", {"move", "obstacle"});
  row.session = fields.flag("session", row.session);
  o.simplify = fields.flag("simplify", o.simplify);
  row.neighbors = fields.text("neighbors", row.neighbors);
  o.neighbors = checked_word(fields, "neighbors", row.neighbors, neighbors_from_string);
  o.cost_factor = fields.number("cost_factor", o.cost_factor, factors);
  o.time_limit = fields.number("time_limit", o.time_limit, time_limits);
  const std::int64_t limit = fields.count("iteration_limit", -1, counts_or_zero);
  if (limit == 0) o.iteration_limit = std::numeric_limits<std::size_t>::max();
  if (limit > 0) o.iteration_limit = static_cast<std::size_t>(limit);
  return row;
}

/// The rows of one entry of `planners` while its lists are combined.
class Combinations {
 public:
  Combinations(const Fields& fields, const PlanRow& common) : fields_(fields), rows_{common} {}

  /// Every row once with each of the values of a key.
  template <typename Value, typename Set>
  void with_each(const char* key, const std::vector<Value>& values, const Set& set) {
    combine(
        key, values, [](const PlanRow&) { return true; }, set);
  }

  /// The same for guided rows; others have but the first of the values.
  template <typename Value, typename Set>
  void with_each_guided(const char* key, const std::vector<Value>& values, const Set& set) {
    combine(
        key, values, [](const PlanRow& row) { return row.guided(); }, set);
  }

  const std::vector<PlanRow>& rows() const { return rows_; }

 private:
  template <typename Value, typename Takes, typename Set>
  void combine(const char* key, const std::vector<Value>& values, const Takes& takes_all, const Set& set) {
    const auto wanted = [&](const PlanRow& row) { return takes_all(row) ? values.size() : std::size_t{1}; };
    const std::size_t all = std::accumulate(rows_.begin(), rows_.end(), std::size_t{0},
                                            [&](std::size_t sum, const PlanRow& row) { return sum + wanted(row); });
    if (all > most_rows) {
      fields_.refuse(key, "fewer values: with the entry's other lists they make " + std::to_string(all) +
                              " rows, at most " + std::to_string(most_rows) + " are possible");
    }
    std::vector<PlanRow> result;
    result.reserve(all);
    for (const PlanRow& row : rows_) {
      for (std::size_t i = 0; i < wanted(row); ++i) {
        result.push_back(row);
        set(result.back(), values[i]);
      }
    }
    rows_ = std::move(result);
  }

  const Fields& fields_;
  std::vector<PlanRow> rows_;
};

/// One row for every combination of the values in lists. An unguided row has no α, model and detail to combine.
std::vector<PlanRow> expanded(const Fields& fields, const PlanRow& fallback) {
  const PlanRow common = read_common(fields, fallback);
  const PlanOptions& o = common.options;
  Combinations all(fields, common);
  all.with_each("planner", fields.texts("planner", {o.planner}),
                [](PlanRow& row, const std::string& planner) { row.options.planner = planner; });
  all.with_each("strategy", fields.texts("strategy", {common.strategy}), [&](PlanRow& row, const std::string& word) {
    row.strategy = word;
    row.options.strategy = checked_word(fields, "strategy", word, strategy_from_string);
  });
  all.with_each("range", fields.numbers("range", {o.range}, lengths),
                [](PlanRow& row, double range) { row.options.range = range; });
  all.with_each_guided("model", fields.texts("model", {common.model}),
                       [](PlanRow& row, const std::string& model) { row.model = model; });
  all.with_each_guided("detail", fields.counts("detail", {common.detail}, details),
                       [](PlanRow& row, int detail) { row.detail = detail; });
  all.with_each_guided("alpha", fields.numbers("alpha", {o.alpha}, shares),
                       [](PlanRow& row, double alpha) { row.options.alpha = alpha; });
  return all.rows();
}

/// Rows are compared with rows that there are.
void check_baselines(const Fields& fields, const std::vector<PlanRow>& rows, const std::set<std::string>& names) {
  for (const PlanRow& row : rows) {
    if (row.baseline.empty() || names.count(row.baseline) != 0) continue;
    fields.refuse_all("the baseline '" + row.baseline + "' of row '" + row.name +
                      "' is no row: expected the name of one");
  }
}

}  // namespace

const std::vector<std::string>& row_keys() {
  static const std::vector<std::string> keys = {
      "planner",   "strategy",       "alpha",          "model",       "detail",     "range",
      "goal_bias", "goal_tolerance", "stop",           "cost_factor", "time_limit", "iteration_limit",
      "neighbors", "motion",         "turning_radius", "simplify",    "after",      "session"};
  return keys;
}

std::vector<PlanRow> read_plan_rows(const Fields& fields, const PlanSuite& robot) {
  fields.require("planners", "a list of planners, each a row of the report");
  for (const std::string& key : row_keys()) {
    if (fields.is_list(key)) fields.refuse(key, "one value; a list belongs to an entry of 'planners'");
  }
  PlanRow fallback = expanded(fields, {}).front();
  fallback.baseline.clear();  // at the top of the file it is the suite's
  std::vector<PlanRow> rows;
  std::set<std::string> names;
  std::vector<std::string> known = row_keys();
  known.insert(known.end(), {"name", "baseline"});
  for (const Fields& child : fields.children("planners")) {
    child.allow_only(known);
    for (PlanRow& row : expanded(child, fallback)) {
      row.name = name_of(child, row);
      check(child, row, robot);
      if (!names.insert(row.name).second) {
        child.refuse_all("a second row is called '" + row.name + "': expected a 'name' of its own");
      }
      rows.push_back(std::move(row));
    }
    if (rows.size() > most_rows) {
      fields.refuse_all("'planners' has too many: expected " + std::to_string(most_rows) + " rows at most");
    }
  }
  check_baselines(fields, rows, names);
  return rows;
}

}  // namespace lrrt::bench
