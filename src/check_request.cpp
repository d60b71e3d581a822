// SPDX-License-Identifier: BSD-3-Clause
#include "check_request.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "lrrt/error.hpp"
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
        "the request has an outline but Motion::plane: an outline needs headings; choose Motion::turning, "
        "Motion::dubins or Motion::reeds_shepp, or give a radius instead");
  }
  if (!request.outline->contains(Eigen::Vector2d::Zero())) {
    throw RequestError("the outline does not hold its reference point (0, 0): shift its vertices");
  }
}

void check_motion(const PlanRequest& request) {
  check_outline(request);
  const char* heading = "a finite angle in radians";
  if (!std::isfinite(request.start_heading)) refuse("start_heading", request.start_heading, heading);
  if (!std::isfinite(request.goal_heading)) refuse("goal_heading", request.goal_heading, heading);
  if (request.motion != Motion::dubins && request.motion != Motion::reeds_shepp) return;
  // Curves are made for a radius of 1: a map of many millions of them defeats their arithmetic.
  const OccupancyMap& map = request.map.get();
  const double least = 1e-6 * map.resolution() * std::max(map.width(), map.height());
  const double most = 1e6 * map.resolution();
  if (!(request.turning_radius >= least && request.turning_radius <= most)) {
    refuse("turning_radius", request.turning_radius,
           "a positive length in map units, from a millionth of the map's side to a million pixels; or Motion::turning "
           "for a robot that turns on the spot");
  }
}

}  // namespace

void check(const PlanOptions& options) {
  check_share("alpha", options.alpha);
  check_share("goal_bias", options.goal_bias);
  check_at_least("range", options.range, 0.0, "0 (choose by the map) or a positive length in map units");
  check_at_least("goal_tolerance", options.goal_tolerance, 0.0, "0 or a positive length in map units");
  check_at_least("cost_factor", options.cost_factor, 1.0, "at least 1");
  if (!(options.time_limit > 0.0)) refuse("time_limit", options.time_limit, "a positive number of seconds");
  check_for_planner(options);
}

void check(const PlanRequest& request, const PlanOptions& options) {
  check_point("start", request.start);
  check_point("goal", request.goal);
  check_motion(request);
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
