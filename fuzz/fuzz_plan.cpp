// SPDX-License-Identifier: BSD-3-Clause
/// Input: bytes that choose a small map, a robot, a query with odd numbers, and options with tiny limits.
#include <fuzzer/FuzzedDataProvider.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "lrrt/error.hpp"
#include "lrrt/ompl/planners.hpp"
#include "lrrt/planner.hpp"
#include "lrrt/predict/grid_predictors.hpp"
#include "support.hpp"

namespace {

using namespace lrrt;

/// A reasonable number most of the time, else one that nobody expects.
double number(FuzzedDataProvider& bytes, double most) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr std::array<double, 12> odd = {
      0.0,  -0.0,  -1.0,   infinity, -infinity, std::numeric_limits<double>::quiet_NaN(),
      1e-9, 1e300, -1e300, 1e9,      5e-324,    std::numeric_limits<double>::max()};
  switch (bytes.ConsumeIntegralInRange(0, 9)) {
    case 0:
      return odd[bytes.ConsumeIntegralInRange<std::size_t>(0, odd.size() - 1)];
    case 1:
      return bytes.ConsumeFloatingPoint<double>();
    default:
      return bytes.ConsumeIntegral<std::uint8_t>() * most / 255.0;
  }
}

Eigen::Vector2d point(FuzzedDataProvider& bytes, double most) {
  const double x = number(bytes, most);
  return {x, number(bytes, most)};
}

OccupancyMap made_map(FuzzedDataProvider& bytes) {
  const int width = bytes.ConsumeIntegralInRange(1, 16);
  const int height = bytes.ConsumeIntegralInRange(1, 16);
  std::vector<Cell> cells(static_cast<std::size_t>(width * height), Cell::free);
  for (Cell& cell : cells) {
    const auto byte = bytes.ConsumeIntegral<std::uint8_t>();
    if (byte > 200) cell = byte > 250 ? Cell::unknown : Cell::occupied;
  }
  if (bytes.ConsumeBool()) return OccupancyMap(width, height, std::move(cells));
  const double resolution = number(bytes, 1.0);
  const Eigen::Vector2d corner = point(bytes, 2.0);
  return OccupancyMap(width, height, std::move(cells), resolution, {corner.x(), corner.y(), number(bytes, 4.0)});
}

PlanOptions made_options(FuzzedDataProvider& bytes) {
  PlanOptions options;
  options.planner = bytes.PickValueInArray({"RRTstar", "RRT", "RRTConnect"});
  if (bytes.ConsumeBool())
    options.planner = planner_names()[bytes.ConsumeIntegral<std::uint8_t>() % planner_names().size()];
  options.strategy = bytes.PickValueInArray({Strategy::uniform, Strategy::region, Strategy::frontier});
  options.stop = bytes.PickValueInArray({Stop::first, Stop::factor, Stop::limit});
  options.neighbors = bytes.PickValueInArray({Neighbors::grid, Neighbors::ompl});
  options.on_predict_error = bytes.PickValueInArray({OnPredictError::raise, OnPredictError::unguided});
  options.iteration_limit = bytes.ConsumeIntegralInRange<std::size_t>(0, 200);
  options.time_limit = 0.05;
  options.keep_tree = bytes.ConsumeBool();
  options.simplify = bytes.ConsumeBool();
  options.seed = bytes.ConsumeIntegral<std::uint64_t>();
  if (bytes.ConsumeBool()) return options;
  options.alpha = number(bytes, 1.0);
  options.range = number(bytes, 4.0);
  options.goal_bias = number(bytes, 1.0);
  options.goal_tolerance = number(bytes, 1.0);
  options.cost_factor = number(bytes, 3.0);
  return options;
}

PlanRequest made_request(FuzzedDataProvider& bytes, const OccupancyMap& map) {
  const double reach = map.resolution() * 16.0;
  const Eigen::Vector2d start = point(bytes, reach);
  PlanRequest request{map, start, point(bytes, reach)};
  if (bytes.ConsumeBool()) request.radius = number(bytes, map.resolution());
  request.unknown = bytes.PickValueInArray({UnknownIs::occupied, UnknownIs::free});
  request.motion = bytes.PickValueInArray({Motion::plane, Motion::turning, Motion::dubins, Motion::reeds_shepp});
  request.turning_radius = number(bytes, 3.0 * map.resolution());
  request.start_heading = number(bytes, 6.3);
  request.goal_heading = number(bytes, 6.3);
  if (bytes.ConsumeBool()) {
    std::vector<Eigen::Vector2d> corners;
    for (int i = bytes.ConsumeIntegralInRange(0, 6); i > 0; --i) {
      corners.push_back(point(bytes, map.resolution()) - Eigen::Vector2d::Constant(0.4 * map.resolution()));
    }
    request.outline = Polygon(std::move(corners));
  }
  return request;
}

std::shared_ptr<const RegionPredictor> made_predictor(FuzzedDataProvider& bytes, const OccupancyMap& map) {
  if (bytes.ConsumeBool()) return std::make_shared<AStarPredictor>(number(bytes, 5.0));
  std::vector<float> probability(map.size());
  for (float& p : probability) p = static_cast<float>(std::clamp(number(bytes, 1.0), 0.0, 1.0));
  return std::make_shared<GivenRegion>(map.width(), map.height(), std::move(probability));
}

void check(const PlanRequest& request, const PlanOptions& options, const PlanResult& result) {
  fuzz::require(result.solved() == !result.path.empty(), "there is a path exactly when the query is solved");
  fuzz::require(result.solved() == std::isfinite(result.cost), "a path has a cost");
  fuzz::require(options.keep_tree || result.tree.empty(), "the tree is told only when it is asked for");
  if (!result.solved()) return;
  fuzz::require(result.cost >= 0.0, "no path is shorter than nothing");
  const OccupancyMap map = request.map.get().resolved(request.unknown);
  for (const Eigen::Vector2d& p : result.path) {
    fuzz::require(p.allFinite(), "a path's points are finite");
    fuzz::require(map.is_free(OccupancyMap::pixel_of(map.to_pixel(p))), "a path's points are free");
  }
  const double slack = 1e-9 * (1.0 + request.start.norm() + request.goal.norm());
  fuzz::require((result.path.front() - request.start).norm() <= slack, "a path begins at the start");
  fuzz::require((result.path.back() - request.goal).norm() <= options.goal_tolerance + slack,
                "a path ends at the goal");
  const bool headed = request.motion != Motion::plane;
  fuzz::require(result.headings.size() == (headed ? result.path.size() : 0), "a pose has a heading");
}

/// An Error of no kind is how the planner says that it contradicts itself: a path that is not free, a refused query.
void plan(const Planner& planner, const PlanRequest& request) {
  try {
    check(request, planner.options(), planner.plan(request));
  } catch (const RequestError&) {
    throw;
  } catch (const ModelError&) {
    throw;
  } catch (const Error& error) {
    fuzz::require(false, error.what());
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const bool quiet = [] {
    silence_ompl();
    return true;
  }();
  FuzzedDataProvider bytes(data, size);
  fuzz::answer_or_typed_error([&] {
    const OccupancyMap map = made_map(bytes);
    const PlanOptions options = made_options(bytes);
    const PlanRequest request = made_request(bytes, map);
    const Planner planner(quiet ? made_predictor(bytes, map) : nullptr, options);
    plan(planner, request);
  });
  return 0;
}
