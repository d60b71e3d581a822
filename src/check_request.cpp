// SPDX-License-Identifier: BSD-3-Clause
#include "check_request.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "lrrt/error.hpp"
#include "lrrt/ompl/control_planners.hpp"
#include "lrrt/ompl/planners.hpp"

namespace lrrt {
namespace {

[[noreturn]] void refuse(const char* name, double value, const char* expected) {
  std::ostringstream text;
  text << name << " is " << value << ": expected " << expected;
  throw RequestError(text.str());
}

void check_share(const char* name, double value) {
  if (!(value >= 0.0 && value <= 1.0)) refuse(name, value, "a share from 0 to 1");
}

void check_at_least(const char* name, double value, double least, const char* expected) {
  if (!(std::isfinite(value) && value >= least)) refuse(name, value, expected);
}

/// Some planners end at their first path, and RRT-Connect needs no goal bias.
void check_for_planner(const PlanOptions& options) {
  check_planner_name(options.planner);
  if (options.stop != Stop::first && !shortens_its_path(options.planner)) {
    throw RequestError("planner " + options.planner +
                       " ends at its first path: use Stop::first, or RRTstar to shorten it");
  }
  if (options.goal_tolerance > 0.0 && !takes_goal_tolerance(options.planner)) {
    throw RequestError("planner " + options.planner +
                       " cannot plan to a goal_tolerance above 0: OMPL's own code ends the process then; set it to 0, "
                       "or choose BITstar");
  }
  if (options.goal_bias == 0.0 && options.goal_tolerance == 0.0 && needs_goal_bias(options.planner)) {
    throw RequestError(
        "goal_bias and goal_tolerance are both 0: a random sample never hits the goal exactly; raise one of them");
  }
}

void check_point(const char* name, const Eigen::Vector2d& point) {
  for (const double coordinate : {point.x(), point.y()}) {
    if (!std::isfinite(coordinate)) refuse(name, coordinate, "two finite coordinates in map units");
  }
}

void check_outline(const PlanRequest& request) {
  if (!request.outline) return;
  if (request.motion == Motion::plane) {
    throw RequestError(
        "the request has an outline but Motion::plane: an outline needs headings; choose another motion, as "
        "Motion::turning, or give a radius instead");
  }
  if (!request.outline->contains(Eigen::Vector2d::Zero())) {
    throw RequestError("the outline does not hold its reference point (0, 0): shift its vertices");
  }
}

/// True for a turning radius that the arithmetic copes with on a map: curves are made for a radius of 1, and many
/// millions of them defeat it.
bool turns_within(double radius, const OccupancyMap& map) {
  const double least = 1e-6 * map.resolution() * std::max(map.width(), map.height());
  return radius >= least && radius <= 1e6 * map.resolution();
}

void check_speeds(const PlanRequest& request) {
  const double pixel = request.map.get().resolution();
  const auto reasonable = [&](double speed) { return speed >= 1e-6 * pixel && speed <= 1e9 * pixel; };
  if (!reasonable(request.speed)) {
    refuse("speed", request.speed, "a positive number of map units per second, from a millionth to 1e9 pixels");
  }
  if (request.reverse_speed != 0.0 && !reasonable(request.reverse_speed)) {
    refuse("reverse_speed", request.reverse_speed,
           "0 for a robot that only drives forwards, or a positive number of map units per second");
  }
  if (request.motion != Motion::unicycle) return;
  if (!(request.turn_rate > 0.0) || !turns_within(request.speed / request.turn_rate, request.map)) {
    refuse("turn_rate", request.turn_rate,
           "a positive number of radians per second; at full speed that has to be a radius from a millionth of the "
           "map's side to a million pixels");
  }
}

void check_motion(const PlanRequest& request) {
  check_outline(request);
  const char* heading = "a finite angle in radians";
  if (!std::isfinite(request.start_heading)) refuse("start_heading", request.start_heading, heading);
  if (!std::isfinite(request.goal_heading)) refuse("goal_heading", request.goal_heading, heading);
  if (is_driven(request.motion)) check_speeds(request);
  const bool turns_anywhere =
      request.motion == Motion::plane || request.motion == Motion::turning || request.motion == Motion::unicycle;
  if (!turns_anywhere && !turns_within(request.turning_radius, request.map)) {
    refuse("turning_radius", request.turning_radius,
           "a positive length in map units, from a millionth of the map's side to a million pixels; or Motion::turning "
           "or Motion::unicycle for a robot that turns on the spot");
  }
}

/// A driven robot has planners of its own, and ends near the goal only.
void check_driven(const PlanOptions& options) {
  check_control_planner_name(options.planner);
  if (options.goal_tolerance == 0.0) {
    throw RequestError(
        "goal_tolerance is 0: a driven robot (Motion::unicycle, Motion::car) never ends exactly at its goal; allow it "
        "a distance in map units");
  }
  if (options.clearance > 0.0) {
    throw RequestError(
        "clearance adds to lengths, but a driven robot's path costs time: leave it 0, or give a radius to be kept");
  }
  if (options.simplify) {
    throw RequestError(
        "simplify is for robots that can move between any two poses; a driven robot cannot: leave it off");
  }
}

}  // namespace

void check(const PlanOptions& options) {
  check_share("alpha", options.alpha);
  check_share("goal_bias", options.goal_bias);
  check_at_least("range", options.range, 0.0, "0 (choose by the map) or a positive length in map units");
  check_at_least("goal_tolerance", options.goal_tolerance, 0.0, "0 or a positive length in map units");
  check_at_least("heading_tolerance", options.heading_tolerance, 1e-6,
                 "a positive angle in radians; pi for any heading");
  check_at_least("clearance", options.clearance, 0.0, "0 (no wish) or a positive length in map units");
  check_at_least("clearance_weight", options.clearance_weight, 0.0, "0 or a positive number");
  check_at_least("cost_factor", options.cost_factor, 1.0, "at least 1");
  if (!(options.time_limit > 0.0)) refuse("time_limit", options.time_limit, "a positive number of seconds");
  check_for_planner(options);
}

void check(const PlanRequest& request, const PlanOptions& options) {
  check_point("start", request.start);
  check_point("goal", request.goal);
  check_motion(request);
  if (is_driven(request.motion)) check_driven(options);
  const double least_range = 1e-3 * request.map.get().resolution();
  if (options.range > 0.0 && options.range < least_range) {
    refuse("range", options.range, "at least a thousandth of a pixel, in map units; or 0 to choose by the map");
  }
  if (request.motion == Motion::dubins && !keeps_direction(options.planner)) {
    throw RequestError(
        "planner " + options.planner +
        " does not tell a motion from the way back, which is another one for a robot that only drives forwards "
        "(Motion::dubins): choose RRT, RRTConnect or RRTstar");
  }
}

}  // namespace lrrt
