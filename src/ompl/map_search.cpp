// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/ompl/map_search.hpp"

#include <ompl/base/PlannerData.h>
#include <ompl/base/goals/GoalState.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/PathGeometric.h>

#include <algorithm>
#include <limits>
#include <tuple>

#include "lrrt/error.hpp"
#include "lrrt/map/shortest_path.hpp"
#include "lrrt/ompl/guide.hpp"

namespace lrrt {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

ob::StateSpacePtr plane_over(const OccupancyMap& map) {
  auto space = std::make_shared<ob::RealVectorStateSpace>(2);
  const Bounds box = map.bounds();
  // A hair wider, so that a point on the map's edge is not lost to the rounding of its conversion.
  const double slack = 1e-9 * map.resolution();
  ob::RealVectorBounds bounds(2);
  for (unsigned int axis = 0; axis < 2; ++axis) {
    bounds.setLow(axis, box.low[axis] - slack);
    bounds.setHigh(axis, box.high[axis] + slack);
  }
  space->setBounds(bounds);
  return space;
}

/// Straightens a pixel path by line of sight between the exact ends. @return its length, map units.
double line_of_sight_length(const CollisionMap& map, const std::vector<Pixel>& path, const Eigen::Vector2d& start,
                            const Eigen::Vector2d& goal) {
  std::vector<Eigen::Vector2d> points{start};
  for (const Pixel p : path) points.push_back(map.map().center(p));
  points.push_back(goal);
  return straightened_length(points, [&](const auto& from, const auto& to) { return map.is_free(from, to); });
}

/// Seeds OMPL's own generator from ours; OMPL refuses 0.
std::uint32_t planner_seed(std::uint64_t seed) {
  return std::max<std::uint32_t>(1U, static_cast<std::uint32_t>(Random(seed).bits() >> 32U));
}

}  // namespace

MapSearch::MapSearch(std::shared_ptr<const CollisionMap> map, const Eigen::Vector2d& start, const Eigen::Vector2d& goal,
                     MixedSampler sampler, const PlanOptions& options, CancelToken cancel)
    : map_(std::move(map)),
      start_(start),
      goal_(goal),
      options_(options),
      projection_(std::make_shared<PlaneProjection>()),
      limits_(std::make_shared<SearchLimits>(options.time_limit, options.iteration_limit, std::move(cancel))) {
  const ob::StateSpacePtr space = plane_over(map_->map());
  si_ = std::make_shared<ob::SpaceInformation>(space);
  si_->setStateValidityChecker(std::make_shared<MapValidityChecker>(si_, map_, projection_));
  si_->setMotionValidator(std::make_shared<MapMotionValidator>(si_, map_, projection_, limits_));
  si_->setup();

  ob::ScopedState<> first(space);
  ob::ScopedState<> last(space);
  projection_->write(start_, first.get());
  projection_->write(goal_, last.get());
  problem_ = std::make_shared<ob::ProblemDefinition>(si_);
  problem_->setStartAndGoalStates(first, last,
                                  std::max(options_.goal_tolerance, std::numeric_limits<double>::epsilon()));
  const auto objective = std::make_shared<ob::PathLengthOptimizationObjective>(si_);
  objective->setCostThreshold(target_cost());
  problem_->setOptimizationObjective(objective);

  planner_ = make_planner(
      options_.planner, si_,
      {options_.range, options_.goal_bias, planner_seed(options_.seed), options_.neighbors == Neighbors::grid});
  planner_.planner->setProblemDefinition(problem_);
  source_ = guide(*planner_.planner, map_, std::move(sampler), projection_);
  planner_.planner->setup();
}

ob::Cost MapSearch::target_cost() const {
  switch (options_.stop) {
    case Stop::first:
      return ob::Cost(std::numeric_limits<double>::infinity());
    case Stop::factor:
      return ob::Cost(options_.cost_factor * reference_cost());
    case Stop::limit:
      break;
  }
  return ob::Cost(0.0);
}

double MapSearch::reference_cost() const {
  const OccupancyMap& map = map_->map();
  const std::vector<Pixel> path =
      shortest_path(map, OccupancyMap::pixel_of(map.to_pixel(start_)), OccupancyMap::pixel_of(map.to_pixel(goal_)));
  return line_of_sight_length(*map_, path, start_, goal_);
}

void MapSearch::run(PlanResult& result) {
  record_costs(result);
  limits_->restart();
  // OMPL's planners ask once an iteration, so the condition also counts them.
  const ob::PlannerTerminationCondition stop([this] { return limits_->next_iteration(); });
  const ob::PlannerStatus status = planner_.planner->solve(stop);
  result.timings.plan = limits_->elapsed_ms();
  result.iterations = limits_->iterations();
  result.nodes = planner_.nodes();
  result.motion_checks =
      si_->getMotionValidator()->getValidMotionCount() + si_->getMotionValidator()->getInvalidMotionCount();
  result.draws = source_->counts();
  if (problem_->hasExactSolution()) {
    read_path(result);
  } else if (status == ob::PlannerStatus::INVALID_START || status == ob::PlannerStatus::INVALID_GOAL) {
    throw Error("OMPL refused the query: " + status.asString() + ", though start and goal are free pixels of the map");
  } else {
    result.status = limits_->reason();
  }
  if (options_.keep_tree) read_tree(result);
}

void MapSearch::record_costs(PlanResult& result) {
  problem_->setIntermediateSolutionCallback(
      [this, &result, guided = problem_->getIntermediateSolutionCallback()](
          const ob::Planner* planner, const std::vector<const ob::State*>& states, const ob::Cost cost) {
        guided(planner, states, cost);
        const bool better = result.cost_history.empty() || cost.value() < result.cost_history.back().cost;
        if (better) result.cost_history.push_back({limits_->elapsed_ms(), limits_->iterations(), cost.value()});
      });
}

void MapSearch::read_path(PlanResult& result) const {
  auto& path = *problem_->getSolutionPath()->as<og::PathGeometric>();
  result.status = PlanStatus::solved;
  for (const ob::State* state : path.getStates()) result.path.push_back(projection_->read(state));
  result.cost = path_length(result.path);
  const bool better = result.cost_history.empty() || result.cost < result.cost_history.back().cost;
  if (better) result.cost_history.push_back({result.timings.plan, limits_->iterations(), result.cost});
}

void MapSearch::read_tree(PlanResult& result) const {
  ob::PlannerData data(si_);
  planner_.planner->getPlannerData(data);
  std::vector<unsigned int> children;
  for (unsigned int parent = 0; parent < data.numVertices(); ++parent) {
    data.getEdges(parent, children);
    const Eigen::Vector2d from = projection_->read(data.getVertex(parent).getState());
    for (const unsigned int child : children) {
      result.tree.push_back({from, projection_->read(data.getVertex(child).getState())});
    }
  }
  // OMPL lists nodes in the order of its neighbour structure, which draws its pivots at random.
  const auto numbers = [](const TreeEdge& e) { return std::make_tuple(e.from.x(), e.from.y(), e.to.x(), e.to.y()); };
  std::sort(result.tree.begin(), result.tree.end(),
            [&](const TreeEdge& a, const TreeEdge& b) { return numbers(a) < numbers(b); });
}

}  // namespace lrrt
