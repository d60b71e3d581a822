// SPDX-License-Identifier: BSD-3-Clause
#include "steps.hpp"

#include <exception>
#include <memory>
#include <string>
#include <utility>

#include "lrrt/error.hpp"
#include "lrrt/ompl/guide.hpp"
#include "lrrt/ompl/map_search.hpp"
#include "lrrt/stopwatch.hpp"

namespace lrrt {
namespace {

/// Longest side, pixels, of the maps on which start and goal are first looked for a way, where nothing is predicted.
constexpr int unguided_detail = 1024;

MapSampler sampler_for(const Prepared& prepared, const PromisingRegion* region, const PlanRequest& request,
                       const PlanOptions& options) {
  if (region == nullptr) {
    const std::shared_ptr<const OccupancyMap> map(prepared.map, &prepared.map->map());
    return {map, {nullptr, UniformStrategy(map->width(), map->height()), options.alpha, options.seed}};
  }
  return make_sampler(prepared.guidance, *region, request.start, request.goal, growth_of(options.planner),
                      {options.strategy, options.alpha, options.range, options.seed});
}

SearchSpace space_for(const Prepared& prepared, const PlanRequest& request, const PlanOptions& options,
                      const std::shared_ptr<SearchLimits>& limits) {
  const ClearanceCost clearance{options.clearance / request.map.get().resolution(), options.clearance_weight};
  if (!prepared.body) return plane_space(prepared.map, clearance, limits);
  if (is_driven(request.motion)) {
    // numbers that have nothing to do with those of the planner, which come from the seed itself
    const auto seed = static_cast<std::uint32_t>(Random(~options.seed).bits() >> 32U) | 1U;
    return drive_space(prepared.map, prepared.body, Drive(request), options.range, prepared.reach, seed, limits);
  }
  return pose_space(prepared.map, prepared.body, request.motion, request.turning_radius, prepared.reach, clearance,
                    limits);
}

/// The result of a query that ends where it starts; OMPL's planners take the goal for one more state to be reached.
void arrive(const PlanRequest& request, PlanResult& result) {
  result.status = PlanStatus::solved;
  result.path = {request.start, request.start};
  if (request.motion != Motion::plane) result.headings.assign(2, wrapped_angle(request.start_heading));
  result.goal_distance = (request.goal - request.start).norm();
  result.goal_turn = request.motion == Motion::plane ? 0.0 : angle_between(request.goal_heading, request.start_heading);
  result.cost = 0.0;
  result.cost_history = {{0.0, 0, 0.0}};
}

}  // namespace

bool given_up(const PlanRequest& request, PlanResult& result) {
  if (!request.cancel.cancelled()) return false;
  result.status = PlanStatus::cancelled;
  return true;
}

FreeSpace make_free_space(const PlanRequest& request, const RegionPredictor* predictor, PlanResult& result) {
  const Stopwatch watch;
  FreeSpace space(request, predictor != nullptr ? predictor->detail() : unguided_detail);
  result.timings.prepare += watch.total_ms();
  return space;
}

std::optional<Prepared> look(FreeSpace& space, const PlanRequest& request, const PlanOptions& options,
                             PlanResult& result) {
  if (given_up(request, result)) return std::nullopt;
  const Stopwatch watch;
  Prepared prepared = space.prepare(request, options);
  result.timings.prepare += watch.total_ms();
  if (prepared.hopeless) result.status = *prepared.hopeless;
  if (prepared.arrived) arrive(request, result);
  if (prepared.hopeless || prepared.arrived || given_up(request, result)) return std::nullopt;
  return prepared;
}

void take_region(Prediction prediction, const Prepared& prepared, const PlanRequest& request, PlanResult& result) {
  const Stopwatch watch;
  const OccupancyMap& map = *prepared.guidance;
  PromisingRegion& region = prediction.region;
  if (region.width() != map.width() || region.height() != map.height()) {
    throw ModelError("the predictor returned a region of " + std::to_string(region.width()) + "×" +
                     std::to_string(region.height()) + " pixels for a map of " + std::to_string(map.width()) + "×" +
                     std::to_string(map.height()) + ": it must be as large as the map");
  }
  if (!region.connected()) {  // start and goal are joined, so there is a way to bridge its gaps
    region = region.bridged(map, OccupancyMap::pixel_of(map.to_pixel(request.start)),
                            OccupancyMap::pixel_of(map.to_pixel(request.goal)));
  }
  result.region = std::make_shared<const PromisingRegion>(std::move(region));
  result.timings.encode = prediction.timings.encode;
  result.timings.infer = prediction.timings.infer;
  result.timings.region = prediction.timings.region + watch.total_ms();
}

std::string failure_of(const PlanOptions& options, const std::function<void()>& predict) {
  try {
    predict();
    return {};
  } catch (const RequestError&) {
    throw;  // start and goal are free by now
  } catch (const std::exception& error) {
    if (options.on_predict_error == OnPredictError::raise) throw;
    return *error.what() != '\0' ? error.what() : "the predictor failed and did not say why";
  }
}

void search(const Prepared& prepared, const PlanRequest& request, PlanOptions options, PlanResult& result) {
  if (given_up(request, result)) return;
  const Stopwatch watch;
  if (options.range == 0.0) options.range = default_range(prepared, request);
  const auto limits = std::make_shared<SearchLimits>(options.time_limit, options.iteration_limit, request.cancel);
  MapSearch search(space_for(prepared, request, options, limits), pose(request.start, request.start_heading),
                   pose(request.goal, request.goal_heading),
                   sampler_for(prepared, result.region.get(), request, options), options, limits);
  result.timings.prepare += watch.total_ms();
  search.run(result);
}

}  // namespace lrrt
