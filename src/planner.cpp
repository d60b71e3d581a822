// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/planner.hpp"

#include <ompl/util/Console.h>

#include <cmath>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

#include "lrrt/error.hpp"
#include "lrrt/map/flood.hpp"
#include "lrrt/map/footprint.hpp"
#include "lrrt/ompl/guide.hpp"
#include "lrrt/ompl/map_search.hpp"
#include "lrrt/ompl/suitable_range.hpp"
#include "lrrt/stopwatch.hpp"

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
  if (options.goal_bias == 0.0 && options.goal_tolerance == 0.0 && needs_goal_bias(options.planner)) {
    throw RequestError(
        "goal_bias and goal_tolerance are both 0: a random sample never hits the goal exactly; raise one of them");
  }
}

void check(const PlanOptions& options) {
  check_share("alpha", options.alpha);
  check_share("goal_bias", options.goal_bias);
  check_at_least("range", options.range, 0.0, "0 (choose by the map) or a positive length in map units");
  check_at_least("goal_tolerance", options.goal_tolerance, 0.0, "0 or a positive length in map units");
  check_at_least("cost_factor", options.cost_factor, 1.0, "at least 1");
  if (!(options.time_limit > 0.0)) refuse("time_limit", options.time_limit, "a positive number of seconds");
  check_for_planner(options);
}

void check_point(const char* name, const Eigen::Vector2d& point) {
  for (const double coordinate : {point.x(), point.y()}) {
    if (!std::isfinite(coordinate)) refuse(name, coordinate, "two finite coordinates in map units");
  }
}

void check(const PlanRequest& request, const PlanOptions& options) {
  check_point("start", request.start);
  check_point("goal", request.goal);
  const double least_range = 1e-3 * request.map.get().resolution();
  if (options.range > 0.0 && options.range < least_range) {
    refuse("range", options.range, "at least a thousandth of a pixel, in map units; or 0 to choose by the map");
  }
}

/// The map that the robot, shrunk to a point, sees: unknown resolved, obstacles grown by its radius.
OccupancyMap planning_map(const PlanRequest& request) {
  return inflated(request.map.get().resolved(request.unknown), request.radius);
}

/// What can be said without a search; nothing when a search is worth it.
std::optional<PlanStatus> hopeless(const OccupancyMap& map, const PlanRequest& request) {
  const Pixel start = OccupancyMap::pixel_of(map.to_pixel(request.start));
  const Pixel goal = OccupancyMap::pixel_of(map.to_pixel(request.goal));
  if (!map.contains(start)) return PlanStatus::start_outside;
  if (!map.contains(goal)) return PlanStatus::goal_outside;
  if (!map.is_free(start)) return PlanStatus::start_occupied;
  if (!map.is_free(goal)) return PlanStatus::goal_occupied;
  if (!Flood(map.free_mask(), map.width(), map.height(), start).reached(goal)) return PlanStatus::not_connected;
  return std::nullopt;
}

/// The predicted region, its gaps closed: start and goal are joined by now, so there is a way to bridge them.
std::shared_ptr<const PromisingRegion> predict(const RegionPredictor& predictor, const OccupancyMap& map,
                                               const PlanRequest& request, PlanTimings& timings) {
  Prediction prediction = predictor.predict(map, request.start, request.goal);
  const Stopwatch watch;
  const PromisingRegion& region = prediction.region;
  if (region.width() != map.width() || region.height() != map.height()) {
    throw RequestError("the predictor returned a region of " + std::to_string(region.width()) + "×" +
                       std::to_string(region.height()) + " pixels for a map of " + std::to_string(map.width()) + "×" +
                       std::to_string(map.height()) + ": it must be as large as the map");
  }
  if (!region.connected()) {
    prediction.region = prediction.region.bridged(map, OccupancyMap::pixel_of(map.to_pixel(request.start)),
                                                  OccupancyMap::pixel_of(map.to_pixel(request.goal)));
  }
  timings.encode = prediction.timings.encode;
  timings.infer = prediction.timings.infer;
  timings.region = prediction.timings.region + watch.total_ms();
  return std::make_shared<const PromisingRegion>(std::move(prediction.region));
}

MixedSampler sampler_for(const std::shared_ptr<const CollisionMap>& map, const PromisingRegion* region,
                         const PlanRequest& request, const PlanOptions& options) {
  if (region == nullptr) {
    return {nullptr, UniformStrategy(map->map().width(), map->map().height()), options.alpha, options.seed};
  }
  return make_sampler(map, *region, request.start, request.goal, growth_of(options.planner),
                      {options.strategy, options.alpha, options.range, options.seed});
}

/// The result of a query that ends where it starts; OMPL's planners take the goal for one more state to be reached.
PlanResult arrived(const PlanRequest& request, const Stopwatch& watch) {
  PlanResult result;
  result.status = PlanStatus::solved;
  result.path = {request.start, request.start};
  result.cost = 0.0;
  result.cost_history = {{0.0, 0, 0.0}};
  result.timings.prepare = result.timings.total = watch.total_ms();
  return result;
}

}  // namespace

Planner::Planner(std::shared_ptr<const RegionPredictor> predictor, PlanOptions options)
    : predictor_(std::move(predictor)), options_(std::move(options)) {
  check(options_);
  if (options_.strategy != Strategy::uniform && !predictor_) {
    throw RequestError(
        "this strategy draws from a promising region and needs a predictor: give one, or choose Strategy::uniform");
  }
}

PlanResult Planner::plan(const PlanRequest& request) const {
  check(request, options_);
  PlanResult result;
  const Stopwatch watch;
  OccupancyMap map = planning_map(request);
  if (const std::optional<PlanStatus> status = hopeless(map, request)) {
    result.status = *status;
    result.timings.prepare = result.timings.total = watch.total_ms();
    return result;
  }
  if ((request.goal - request.start).norm() <= options_.goal_tolerance) return arrived(request, watch);
  const auto collision = std::make_shared<const CollisionMap>(std::move(map));
  result.timings.prepare = watch.total_ms();

  if (options_.strategy != Strategy::uniform) {
    result.region = predict(*predictor_, collision->map(), request, result.timings);
  }

  Stopwatch search_watch;
  PlanOptions options = options_;
  if (options.range == 0.0) options.range = suitable_range(*collision);
  MapSearch search(collision, request.start, request.goal,
                   sampler_for(collision, result.region.get(), request, options), options, request.cancel);
  result.timings.prepare += search_watch.lap_ms();
  search.run(result);
  result.timings.total = watch.total_ms();
  return result;
}

void silence_ompl() {
  ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
}

}  // namespace lrrt
