// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/ompl/map_search.hpp"

#include <ompl/base/PlannerData.h>
#include <ompl/base/goals/GoalState.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <tuple>

#include "lrrt/error.hpp"
#include "lrrt/map/shortest_path.hpp"
#include "lrrt/ompl/control_planners.hpp"
#include "lrrt/ompl/guide.hpp"
#include "lrrt/ompl/shorten.hpp"

namespace lrrt {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;
namespace og = ompl::geometric;

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

MapSearch::MapSearch(SearchSpace space, const Pose2& start, const Pose2& goal, MapSampler sampler,
                     const PlanOptions& options, std::shared_ptr<SearchLimits> limits)
    : space_(std::move(space)), goal_(goal), options_(options), limits_(std::move(limits)) {
  problem_ = std::make_shared<ob::ProblemDefinition>(space_.si);
  problem_->addStartState(state_at(start));
  problem_->setGoal(goal_region());
  space_.objective->setCostThreshold(target_cost());
  problem_->setOptimizationObjective(space_.objective);
  planner_ = planner();
  planner_.planner->setProblemDefinition(problem_);
  source_ = guide(*planner_.planner, std::move(sampler), space_.projection);
  source_->end_with([this] { return limits_->interrupted_at_motion(); }, problem_->getStartState(0));
  planner_.planner->setup();
}

ob::ScopedState<> MapSearch::state_at(const Pose2& pose) const {
  ob::ScopedState<> state(space_.si);
  space_.projection->write({pose.x, pose.y}, state.get());
  if (space_.projection->has_heading()) space_.projection->write_heading(pose.yaw, state.get());
  if (space_.driver) DriveSpace::set_time(0.0, state.get());
  return state;
}

ob::GoalPtr MapSearch::goal_region() const {
  if (space_.driver) {
    return std::make_shared<PoseGoal>(space_.si, goal_, options_.goal_tolerance, options_.heading_tolerance,
                                      planner_seed(options_.seed));
  }
  auto goal = std::make_shared<ob::GoalState>(space_.si);
  goal->setState(state_at(goal_));
  goal->setThreshold(std::max(options_.goal_tolerance, std::numeric_limits<double>::epsilon()));
  return goal;
}

MapPlanner MapSearch::planner() const {
  const PlannerSettings settings{options_.range, options_.goal_bias, planner_seed(options_.seed),
                                 options_.neighbors == Neighbors::grid};
  if (!space_.driver) return make_planner(options_.planner, space_.si, settings);
  return make_control_planner(options_.planner, std::static_pointer_cast<oc::SpaceInformation>(space_.si), settings);
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
  const OccupancyMap& map = space_.map->map();
  const Eigen::Vector2d start = space_.projection->read(problem_->getStartState(0));
  const Eigen::Vector2d goal(goal_.x, goal_.y);
  if (options_.clearance > 0.0) return clearance_cost(start, goal);
  const std::vector<Pixel> path =
      shortest_path(map, OccupancyMap::pixel_of(map.to_pixel(start)), OccupancyMap::pixel_of(map.to_pixel(goal)));
  const double length = line_of_sight_length(*space_.map, path, start, goal);
  return space_.driver ? length / space_.driver->drive.top_speed() : length;
}

double MapSearch::clearance_cost(const Eigen::Vector2d& start, const Eigen::Vector2d& goal) const {
  const OccupancyMap& map = space_.map->map();
  const Eigen::Vector2d from = map.to_pixel(start);
  const Eigen::Vector2d to = map.to_pixel(goal);
  const ClearanceCost clearance{options_.clearance / map.resolution(), options_.clearance_weight};
  std::vector<Eigen::Vector2d> points =
      smoothed(map, shortest_path(map, OccupancyMap::pixel_of(from), OccupancyMap::pixel_of(to), clearance), clearance);
  points.front() = from;
  points.push_back(to);
  const ClearanceSurcharge surcharge(map, space_.map->field(), clearance);
  double cost = path_length(points) * map.resolution();
  for (std::size_t i = 1; i < points.size(); ++i) cost += surcharge.along(points[i - 1], points[i]);
  return cost;
}

void MapSearch::run(PlanResult& result) {
  record_costs(result);
  limits_->restart();
  // OMPL's planners ask once an iteration, so the condition also counts them.
  const ob::PlannerTerminationCondition stop([this] {
    if (planner_.announce) planner_.announce();
    return limits_->next_iteration();
  });
  const ob::PlannerStatus status = planner_.planner->solve(stop);
  result.timings.plan = limits_->elapsed_ms();
  result.iterations = limits_->iterations();
  result.nodes = planner_.nodes();
  const ob::MotionValidator& checked = *problem_->getSpaceInformation()->getMotionValidator();
  result.motion_checks = space_.driver ? space_.driver->propagator->checks()
                                       : checked.getValidMotionCount() + checked.getInvalidMotionCount();
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

std::optional<Trace> MapSearch::shortened(const og::PathGeometric& path) const {
  og::PathGeometric shorter(path);
  const ob::PlannerTerminationCondition stop([this] { return limits_->interrupted(); });
  shorten(shorter, stop, planner_seed(options_.seed));
  if (!(shorter.cost(space_.objective).value() < path.cost(space_.objective).value())) return std::nullopt;
  return space_.tell(shorter);
}

void MapSearch::read_path(PlanResult& result) const {
  const ob::Path& path = *problem_->getSolutionPath();
  std::optional<Trace> trace;
  if (options_.simplify) trace = shortened(*path.as<og::PathGeometric>());
  if (!trace) trace = space_.tell(path);
  if (!trace) {
    throw Error("OMPL's planner " + options_.planner + " returned a path that is not free: choose another planner");
  }
  result.status = PlanStatus::solved;
  result.path = std::move(trace->points);
  result.headings = std::move(trace->headings);
  result.controls = std::move(trace->controls);
  result.cost = trace->cost;
  result.goal_distance = (result.path.back() - Eigen::Vector2d(goal_.x, goal_.y)).norm();
  result.goal_turn = result.headings.empty() ? 0.0 : angle_between(result.headings.back(), goal_.yaw);
  result.timings.plan = limits_->elapsed_ms();
  const bool better = result.cost_history.empty() || result.cost < result.cost_history.back().cost;
  if (better) result.cost_history.push_back({result.timings.plan, limits_->iterations(), result.cost});
}

void MapSearch::read_tree(PlanResult& result) const {
  // BIT* and AIT* put what they tell into one set for all threads, where it stays.
  static std::mutex one_at_a_time;
  ob::PlannerData data(space_.si);
  {
    const std::lock_guard<std::mutex> lock(one_at_a_time);
    planner_.planner->getPlannerData(data);
  }
  std::vector<unsigned int> children;
  for (unsigned int parent = 0; parent < data.numVertices(); ++parent) {
    data.getEdges(parent, children);
    const Eigen::Vector2d from = space_.projection->read(data.getVertex(parent).getState());
    for (const unsigned int child : children) {
      result.tree.push_back({from, space_.projection->read(data.getVertex(child).getState())});
    }
  }
  // OMPL lists nodes in the order of its neighbour structure, which draws its pivots at random.
  const auto numbers = [](const TreeEdge& e) { return std::make_tuple(e.from.x(), e.from.y(), e.to.x(), e.to.y()); };
  std::sort(result.tree.begin(), result.tree.end(),
            [&](const TreeEdge& a, const TreeEdge& b) { return numbers(a) < numbers(b); });
}

}  // namespace lrrt
