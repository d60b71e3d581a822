// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <future>
#include <optional>

#include "bindings.hpp"
#include "lrrt/error.hpp"
#include "lrrt/ompl/control_planners.hpp"
#include "lrrt/ompl/planners.hpp"
#include "lrrt/planner.hpp"
#include "lrrt/session.hpp"

namespace lrrt::python {
namespace {

/// Runs a search in a second thread while this one looks for Python's signals, so that Ctrl-C ends a long search at
/// once.
template <typename Search>
auto interruptibly(CancelToken cancel, Search&& search) {
  using std::chrono_literals::operator""ms;
  std::future<decltype(search(cancel))> future;
  const auto ready = [&] {
    const py::gil_scoped_release release;
    return future.wait_for(20ms) == std::future_status::ready;
  };
  future = std::async(std::launch::async, [&] { return search(cancel); });
  while (!ready()) {
    if (PyErr_CheckSignals() == 0) continue;
    cancel.cancel();
    {
      const py::gil_scoped_release release;
      future.wait();
    }
    throw py::error_already_set();
  }
  return future.get();
}

UnknownIs unknown_from(const std::string& word) {
  if (word == "occupied") return UnknownIs::occupied;
  if (word == "free") return UnknownIs::free;
  throw RequestError("unknown='" + word + "': expected 'occupied' or 'free'");
}

using Predictor = std::optional<std::shared_ptr<RegionPredictor>>;
using Cancel = std::optional<CancelToken>;

/// How to plan, and for what robot: everything that plan() and Session take by name.
struct Settings {
  PlanOptions options;
  double radius = 0.0;
  UnknownIs unknown = UnknownIs::occupied;
  std::optional<Polygon> outline;
  Motion motion = Motion::plane;
  double turning_radius = 0.0;
  double speed = 0.0;
  double reverse_speed = 0.0;
  double turn_rate = 0.0;

  PlanRequest robot_on(const OccupancyMap& map) const {
    PlanRequest request{map, map.center({0, 0}), map.center({0, 0}), radius, unknown};
    request.outline = outline;
    request.motion = motion;
    request.turning_radius = turning_radius;
    request.speed = speed;
    request.reverse_speed = reverse_speed;
    request.turn_rate = turn_rate;
    return request;
  }
};

Settings settings(const std::string& planner, const std::string& strategy, double alpha, const std::string& stop,
                  double cost_factor, double time_limit, std::optional<std::size_t> iteration_limit, double range,
                  double goal_bias, double goal_tolerance, double radius, const std::string& unknown,
                  std::uint64_t seed, bool keep_tree, const std::string& neighbors,
                  const std::optional<std::vector<Eigen::Vector2d>>& outline, const std::string& motion,
                  double turning_radius, bool simplify, const std::string& on_predict_error, double speed,
                  double reverse_speed, double turn_rate, double heading_tolerance, double clearance,
                  double clearance_weight) {
  Settings result;
  PlanOptions& options = result.options;
  options.planner = planner;
  options.strategy = strategy_from_string(strategy);
  options.alpha = alpha;
  options.range = range;
  options.goal_bias = goal_bias;
  options.goal_tolerance = goal_tolerance;
  options.stop = stop_from_string(stop);
  options.cost_factor = cost_factor;
  options.time_limit = time_limit;
  if (iteration_limit) options.iteration_limit = *iteration_limit;
  options.seed = seed;
  options.keep_tree = keep_tree;
  options.neighbors = neighbors_from_string(neighbors);
  options.simplify = simplify;
  options.on_predict_error = on_predict_error_from_string(on_predict_error);
  result.radius = radius;
  result.unknown = unknown_from(unknown);
  if (outline) result.outline.emplace(*outline);
  result.motion = motion_from_string(motion);
  result.turning_radius = turning_radius;
  result.speed = speed;
  result.reverse_speed = reverse_speed;
  result.turn_rate = turn_rate;
  options.heading_tolerance = heading_tolerance;
  options.clearance = clearance;
  options.clearance_weight = clearance_weight;
  return result;
}

PlanResult plan(const Settings& settings, const Predictor& predictor, const OccupancyMap& map,
                const Eigen::Vector2d& start, const Eigen::Vector2d& goal, double start_heading, double goal_heading,
                const Cancel& cancel) {
  PlanRequest request = settings.robot_on(map);
  request.start = start;
  request.goal = goal;
  request.start_heading = start_heading;
  request.goal_heading = goal_heading;
  const Planner planner(predictor.value_or(nullptr), settings.options);
  return interruptibly(cancel.value_or(CancelToken()), [&](const CancelToken& token) {
    request.cancel = token;
    return planner.plan(request);
  });
}

py::array_t<double> points_array(const std::vector<Eigen::Vector2d>& points) {
  std::vector<double> flat;
  flat.reserve(2 * points.size());
  for (const Eigen::Vector2d& p : points) flat.insert(flat.end(), {p.x(), p.y()});
  return to_array(std::move(flat), {static_cast<py::ssize_t>(points.size()), 2});
}

py::array_t<double> controls_array(const PlanResult& result) {
  std::vector<double> flat;
  flat.reserve(3 * result.controls.size());
  for (const Control& c : result.controls) flat.insert(flat.end(), {c.speed, c.turn_rate, c.duration});
  return to_array(std::move(flat), {static_cast<py::ssize_t>(result.controls.size()), 3});
}

py::array_t<double> history_array(const PlanResult& result) {
  std::vector<double> flat;
  for (const CostStep& step : result.cost_history) {
    flat.insert(flat.end(), {step.time, static_cast<double>(step.iteration), step.cost});
  }
  return to_array(std::move(flat), {static_cast<py::ssize_t>(result.cost_history.size()), 3});
}

py::array_t<double> tree_array(const PlanResult& result) {
  std::vector<double> flat;
  flat.reserve(4 * result.tree.size());
  for (const TreeEdge& edge : result.tree)
    flat.insert(flat.end(), {edge.from.x(), edge.from.y(), edge.to.x(), edge.to.y()});
  return to_array(std::move(flat), {static_cast<py::ssize_t>(result.tree.size()), 4});
}

py::dict timings_dict(const PlanTimings& timings) {
  py::dict result;
  result["prepare"] = timings.prepare;
  result["encode"] = timings.encode;
  result["infer"] = timings.infer;
  result["region"] = timings.region;
  result["plan"] = timings.plan;
  result["total"] = timings.total;
  return result;
}

py::dict draws_dict(const DrawCounts& draws) {
  py::dict result;
  result["guided"] = draws.guided;
  result["uniform"] = draws.uniform;
  return result;
}

void bind_result(py::module_& module) {
  py::class_<PlanResult>(module, "PlanResult", "What came out of plan().")
      .def_property_readonly(
          "status", [](const PlanResult& r) { return to_string(r.status); },
          "solved, start_outside, goal_outside, start_occupied, goal_occupied, not_connected, time_limit, "
          "iteration_limit or cancelled.")
      .def_property_readonly("solved", &PlanResult::solved, "True when a free path was found.")
      .def_property_readonly(
          "path", [](const PlanResult& r) { return points_array(r.path); },
          "(N, 2) float64, map units, from start to goal; (0, 2) unless solved. Corners in the plane, else a point "
          "for about every pixel of motion.")
      .def_property_readonly(
          "headings",
          [](const PlanResult& r) { return to_array(r.headings, {static_cast<py::ssize_t>(r.headings.size())}); },
          "(N,) float64, radians in [-pi, pi) from the map's x axis towards its y axis; (0,) in the plane.")
      .def_property_readonly(
          "controls", &controls_array,
          "(K, 3) float64: speed (map units per second, negative backwards), turn rate (radians per second) and "
          "duration (seconds) of what drives a unicycle or a car along the path; (0, 3) for other motions.")
      .def_readonly("goal_distance", &PlanResult::goal_distance,
                    "From the path's end to the goal, map units; inf unless solved.")
      .def_readonly("goal_turn", &PlanResult::goal_turn,
                    "From the heading at the path's end to goal_heading, radians; inf unless solved.")
      .def_readonly("cost", &PlanResult::cost,
                    "Length of the path, map units, or the seconds that its controls take, see plan(); inf unless "
                    "solved.")
      .def_readonly("iterations", &PlanResult::iterations, "Iterations of the planner.")
      .def_readonly("nodes", &PlanResult::nodes, "Nodes in the planner's tree.")
      .def_readonly("motion_checks", &PlanResult::motion_checks, "Motions that were checked for collisions.")
      .def_property_readonly(
          "draws", [](const PlanResult& r) { return draws_dict(r.draws); },
          "Samples drawn: {'guided': from the region, 'uniform': from the whole map}.")
      .def_property_readonly("cost_history", &history_array,
                             "(K, 3) float64: milliseconds, iteration and cost of every better path.")
      .def_property_readonly("tree", &tree_array, "(M, 4) float64, map units: x0, y0, x1, y1; with keep_tree=True.")
      .def_property_readonly(
          "region", [](const PlanResult& r) { return std::const_pointer_cast<PromisingRegion>(r.region); },
          "The promising region that was used, or None.")
      .def_readonly("reused", &PlanResult::reused,
                    "Share of the path's cost that Session.replan() took over from the path before; else 0.")
      .def_property_readonly(
          "predict_error", text_getter(&PlanResult::predict_error),
          "Why the plan was made unguided, with on_predict_error='unguided'; '' when nothing failed.")
      .def_property_readonly(
          "timings", [](const PlanResult& r) { return timings_dict(r.timings); },
          "Milliseconds of each stage: prepare, encode, infer, region, plan, total.")
      .def("__repr__", [](const PlanResult& r) {
        return std::string("PlanResult(") + to_string(r.status) + ", cost=" + std::to_string(r.cost) +
               ", iterations=" + std::to_string(r.iterations) + ", nodes=" + std::to_string(r.nodes) + ")";
      });
}

void bind_settings(py::module_& module) {
  const PlanOptions defaults;
  py::class_<Settings>(module, "Settings", "How to plan, and for what robot. See lrrt.plan.")
      .def(py::init(&settings), py::kw_only(), py::arg("planner") = defaults.planner, py::arg("strategy") = "frontier",
           py::arg("alpha") = defaults.alpha, py::arg("stop") = "first", py::arg("cost_factor") = defaults.cost_factor,
           py::arg("time_limit") = defaults.time_limit, py::arg("iteration_limit") = py::none(),
           py::arg("range") = defaults.range, py::arg("goal_bias") = defaults.goal_bias,
           py::arg("goal_tolerance") = defaults.goal_tolerance, py::arg("radius") = 0.0,
           py::arg("unknown") = "occupied", py::arg("seed") = defaults.seed, py::arg("keep_tree") = false,
           py::arg("neighbors") = "grid", py::arg("outline") = py::none(), py::arg("motion") = "plane",
           py::arg("turning_radius") = 0.0, py::arg("simplify") = false, py::arg("on_predict_error") = "raise",
           py::arg("speed") = 0.0, py::arg("reverse_speed") = 0.0, py::arg("turn_rate") = 0.0,
           py::arg("heading_tolerance") = defaults.heading_tolerance, py::arg("clearance") = defaults.clearance,
           py::arg("clearance_weight") = defaults.clearance_weight);
}

void bind_session(py::module_& module) {
  py::class_<Session>(module, "Session", "Many queries on one map. See lrrt.Session.")
      .def(py::init([](const Settings& settings, const Predictor& predictor, const OccupancyMap& map) {
             return Session(Planner(predictor.value_or(nullptr), settings.options), settings.robot_on(map));
           }),
           py::arg("settings"), py::arg("predictor"), py::arg("map"))
      .def_property_readonly("map", &Session::map, py::return_value_policy::copy, "The map as it is now; a copy.")
      .def(
          "plan",
          [](Session& session, const std::vector<Query>& queries, const Cancel& cancel) {
            return interruptibly(cancel.value_or(CancelToken()),
                                 [&](const CancelToken& token) { return session.plan(queries, token); });
          },
          py::arg("queries"), py::arg("cancel"))
      .def(
          "replan",
          [](Session& session, const Eigen::Vector2d& start, double heading, const Cancel& cancel) {
            return interruptibly(cancel.value_or(CancelToken()),
                                 [&](const CancelToken& token) { return session.replan(start, heading, token); });
          },
          py::arg("start"), py::arg("heading"), py::arg("cancel"))
      .def("update", &Session::update, py::arg("part"), py::call_guard<py::gil_scoped_release>());
  py::class_<Query>(module, "Query", "Where a robot is and where it shall go.")
      .def(py::init([](const Eigen::Vector2d& start, const Eigen::Vector2d& goal, double start_heading,
                       double goal_heading) {
             return Query{start, goal, start_heading, goal_heading};
           }),
           py::arg("start"), py::arg("goal"), py::arg("start_heading") = 0.0, py::arg("goal_heading") = 0.0)
      .def_readonly("start", &Query::start, "(x, y), map units.")
      .def_readonly("goal", &Query::goal, "(x, y), map units.")
      .def_readonly("start_heading", &Query::start_heading, "Radians.")
      .def_readonly("goal_heading", &Query::goal_heading, "Radians.");
}

}  // namespace

void bind_planner(py::module_& module) {
  silence_ompl();
  py::class_<CancelToken>(module, "CancelToken", "Ends a search from another thread.")
      .def(py::init<>())
      .def("cancel", &CancelToken::cancel, "Asks the search to stop as soon as it can.")
      .def_property_readonly("cancelled", &CancelToken::cancelled, "True once cancel() was called.");
  bind_result(module);
  module.def("planner_names", &planner_names, "Names that plan() accepts as `planner`.");
  module.def("control_planner_names", &control_planner_names,
             "Those of them that plan() accepts for motion='unicycle' and 'car'.");
  bind_settings(module);
  module.def("plan", &plan, py::arg("settings"), py::arg("predictor"), py::arg("map"), py::arg("start"),
             py::arg("goal"), py::arg("start_heading"), py::arg("goal_heading"), py::arg("cancel"),
             "Plans a path. See lrrt.plan.");
  bind_session(module);
}

}  // namespace lrrt::python
