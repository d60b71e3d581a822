// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/planner.hpp"

#include <ompl/util/Console.h>

#include <cmath>
#include <sstream>
#include <utility>

#include "lrrt/error.hpp"
#include "lrrt/map/components.hpp"
#include "lrrt/map/footprint.hpp"
#include "lrrt/ompl/map_search.hpp"
#include "lrrt/stopwatch.hpp"

namespace lrrt {
namespace {

[[noreturn]] void refuse(const char* option, double value, const char* expected) {
  std::ostringstream text;
  text << option << " is " << value << ": expected " << expected;
  throw RequestError(text.str());
}

void check(const PlanOptions& options) {
  const auto finite_from = [](double value, double low) { return std::isfinite(value) && value >= low; };
  if (!(options.alpha >= 0.0 && options.alpha <= 1.0)) refuse("alpha", options.alpha, "a share from 0 to 1");
  if (!(options.goal_bias >= 0.0 && options.goal_bias <= 1.0))
    refuse("goal_bias", options.goal_bias, "a share from 0 to 1");
  if (!finite_from(options.range, 0.0))
    refuse("range", options.range, "0 (choose by the map) or a positive length in map units");
  if (!finite_from(options.goal_tolerance, 0.0))
    refuse("goal_tolerance", options.goal_tolerance, "0 or a positive length in map units");
  if (!finite_from(options.cost_factor, 1.0)) refuse("cost_factor", options.cost_factor, "at least 1");
  check_planner_name(options.planner);
  if (!(options.time_limit > 0.0)) refuse("time_limit", options.time_limit, "a positive number of seconds");
}

void check(const PlanRequest& request) {
  if (!request.start.allFinite())
    refuse("start", request.start.x() + request.start.y(), "finite coordinates in map units");
  if (!request.goal.allFinite()) refuse("goal", request.goal.x() + request.goal.y(), "finite coordinates in map units");
}

/// The map that the robot, shrunk to a point, sees: unknown resolved, obstacles grown by its radius.
OccupancyMap planning_map(const PlanRequest& request) {
  return inflated(request.map.resolved(request.unknown), request.radius);
}

/// What can be said without a search; nothing when a search is worth it.
std::optional<PlanStatus> hopeless(const OccupancyMap& map, const PlanRequest& request) {
  const Pixel start = OccupancyMap::pixel_of(map.to_pixel(request.start));
  const Pixel goal = OccupancyMap::pixel_of(map.to_pixel(request.goal));
  if (!map.contains(start)) return PlanStatus::start_outside;
  if (!map.contains(goal)) return PlanStatus::goal_outside;
  if (!map.is_free(start)) return PlanStatus::start_occupied;
  if (!map.is_free(goal)) return PlanStatus::goal_occupied;
  if (!Components(map).joined(start, goal)) return PlanStatus::not_connected;
  return std::nullopt;
}

/// The predicted region, its gaps closed: start and goal are joined by now, so there is a way to bridge them.
PromisingRegion predict(const RegionPredictor& predictor, const OccupancyMap& map, const PlanRequest& request,
                        PlanTimings& timings) {
  const Prediction prediction = predictor.predict(map, request.start, request.goal);
  const Stopwatch watch;
  PromisingRegion region = prediction.region.bridged(map, OccupancyMap::pixel_of(map.to_pixel(request.start)),
                                                     OccupancyMap::pixel_of(map.to_pixel(request.goal)));
  timings.encode = prediction.timings.encode;
  timings.infer = prediction.timings.infer;
  timings.region = prediction.timings.region + watch.total_ms();
  return region;
}

MixedSampler sampler_for(const OccupancyMap& map, const std::optional<PromisingRegion>& region,
                         const PlanOptions& options) {
  std::unique_ptr<SamplingStrategy> guided;
  if (region && region->area() > 0) guided = std::make_unique<RegionStrategy>(*region);
  return {std::move(guided), UniformStrategy(map.width(), map.height()), options.alpha, options.seed};
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
  check(request);
  PlanResult result;
  const Stopwatch watch;
  OccupancyMap map = planning_map(request);
  if (const std::optional<PlanStatus> status = hopeless(map, request)) {
    result.status = *status;
    result.timings.prepare = result.timings.total = watch.total_ms();
    return result;
  }
  if ((request.goal - request.start).norm() <= options_.goal_tolerance) {
    return arrived(request, watch);
  }
  const auto collision = std::make_shared<const CollisionMap>(std::move(map));
  result.timings.prepare = watch.total_ms();

  if (options_.strategy != Strategy::uniform) {
    result.promising = predict(*predictor_, collision->map(), request, result.timings);
  }
  MapSearch search(collision, request.start, request.goal, sampler_for(collision->map(), result.promising, options_),
                   options_);
  search.run(result);
  result.timings.total = watch.total_ms();
  return result;
}

void silence_ompl() {
  ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
}

}  // namespace lrrt
