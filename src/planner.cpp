// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/planner.hpp"

#include <ompl/util/Console.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "check_request.hpp"
#include "free_space.hpp"
#include "lrrt/error.hpp"
#include "lrrt/ompl/guide.hpp"
#include "lrrt/ompl/map_search.hpp"
#include "lrrt/stopwatch.hpp"

namespace lrrt {
namespace {

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

MapSampler sampler_for(const Prepared& prepared, const PromisingRegion* region, const PlanRequest& request,
                       const PlanOptions& options) {
  if (region == nullptr) {
    const std::shared_ptr<const OccupancyMap> map(prepared.map, &prepared.map->map());
    return {map, {nullptr, UniformStrategy(map->width(), map->height()), options.alpha, options.seed}};
  }
  return make_sampler(prepared.guidance, *region, request.start, request.goal, growth_of(options.planner),
                      {options.strategy, options.alpha, options.range, options.seed});
}

/// Longest side, pixels, of the maps on which start and goal are first looked for a way, where nothing is predicted.
constexpr int unguided_detail = 1024;

SearchSpace space_for(const Prepared& prepared, const PlanRequest& request,
                      const std::shared_ptr<SearchLimits>& limits) {
  if (!prepared.body) return plane_space(prepared.map, limits);
  return pose_space(prepared.map, prepared.body, request.motion, request.turning_radius, prepared.reach, limits);
}

/// The result of a query that ends where it starts; OMPL's planners take the goal for one more state to be reached.
void arrive(const PlanRequest& request, PlanResult& result) {
  result.status = PlanStatus::solved;
  result.path = {request.start, request.start};
  if (request.motion != Motion::plane) result.headings.assign(2, wrapped_angle(request.start_heading));
  result.cost = 0.0;
  result.cost_history = {{0.0, 0, 0.0}};
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
  const bool guided = options_.strategy != Strategy::uniform;
  FreeSpace space(request, guided ? predictor_->detail() : unguided_detail);
  const Prepared prepared = space.prepare(request, options_.goal_tolerance);
  result.timings.prepare = result.timings.total = watch.total_ms();
  if (prepared.hopeless) {
    result.status = *prepared.hopeless;
    return result;
  }
  if (prepared.arrived) {
    arrive(request, result);
    return result;
  }

  if (guided) result.region = predict(*predictor_, *prepared.guidance, request, result.timings);

  Stopwatch search_watch;
  PlanOptions options = options_;
  if (options.range == 0.0) options.range = default_range(prepared, request);
  const auto limits = std::make_shared<SearchLimits>(options.time_limit, options.iteration_limit, request.cancel);
  MapSearch search(space_for(prepared, request, limits), pose(request.start, request.start_heading),
                   pose(request.goal, request.goal_heading),
                   sampler_for(prepared, result.region.get(), request, options), options, limits);
  result.timings.prepare += search_watch.lap_ms();
  search.run(result);
  result.timings.total = watch.total_ms();
  return result;
}

void silence_ompl() {
  ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
}

}  // namespace lrrt
