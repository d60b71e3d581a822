// SPDX-License-Identifier: BSD-3-Clause
#include "portfolio.hpp"

#include <ompl/base/ScopedState.h>
#include <ompl/geometric/planners/AnytimePathShortening.h>
#include <ompl/geometric/planners/kpiece/LBKPIECE1.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>

#include <limits>
#include <memory>
#include <optional>

#include "lrrt/map/footprint.hpp"
#include "lrrt/ompl/search_space.hpp"
#include "lrrt/stopwatch.hpp"
#include "robot.hpp"

namespace lrrt::bench {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

SearchSpace space_of(const Problem& problem, const PlanSuite& suite, const PlanRow& row) {
  const OccupancyMap map = planning_map(problem, suite);
  const Motion motion = motion_from_string(row.motion);
  if (motion == Motion::plane) return plane_space(std::make_shared<const CollisionMap>(map), {}, nullptr);
  const Polygon outline = outline_at(suite, problem.scale).value();
  const auto room = std::make_shared<const CollisionMap>(inflated(map, outline.inscribed_radius()));
  const auto body = std::make_shared<const CollisionBody>(std::make_shared<const CollisionMap>(map), outline);
  return pose_space(room, body, motion, row.turning_radius * problem.scale, outline.circumscribed_radius(), {},
                    nullptr);
}

ob::ScopedState<> state_of(const SearchSpace& space, const Eigen::Vector2d& place, double heading) {
  ob::ScopedState<> state(space.si);
  space.projection->write(place, state.get());
  if (space.projection->has_heading()) space.projection->write_heading(heading, state.get());
  return state;
}

template <typename... Planners>
std::shared_ptr<og::AnytimePathShortening> portfolio_of(const ob::SpaceInformationPtr& si, double range) {
  const auto made = og::AnytimePathShortening::createPlanner<Planners...>(si);
  for (unsigned int i = 0; i < made->getNumPlanners(); ++i) {
    if (range > 0.0) made->getPlanner(i)->params().setParam("range", std::to_string(range));
  }
  return made;
}

}  // namespace

PlanResult portfolio_search(const Problem& problem, const PlanSuite& suite, const PlanRow& row,
                            const CancelToken& cancel) {
  PlanResult result;
  const Stopwatch watch;
  const SearchSpace space = space_of(problem, suite, row);
  const auto definition = std::make_shared<ob::ProblemDefinition>(space.si);
  definition->setStartAndGoalStates(state_of(space, problem.start, problem.start_heading),
                                    state_of(space, problem.goal, problem.goal_heading));
  const double enough = row.options.stop == Stop::first ? std::numeric_limits<double>::infinity() : 0.0;
  space.objective->setCostThreshold(ob::Cost(enough));
  definition->setOptimizationObjective(space.objective);
  const auto planner = portfolio_of<og::RRTConnect, og::LBKPIECE1>(space.si, row.options.range * problem.scale);
  planner->setProblemDefinition(definition);
  planner->setup();
  result.timings.prepare = watch.total_ms();
  const double latest = result.timings.prepare + 1e3 * row.options.time_limit;
  planner->solve(ob::PlannerTerminationCondition([&] { return cancel.cancelled() || watch.total_ms() > latest; }));
  result.timings.total = watch.total_ms();
  result.timings.plan = result.timings.total - result.timings.prepare;
  const ob::PathPtr path = definition->hasExactSolution() ? definition->getSolutionPath() : nullptr;
  const std::optional<Trace> trace = path ? space.tell(*path) : std::nullopt;
  if (!trace) return result;
  result.status = PlanStatus::solved;
  result.path = trace->points;
  result.headings = trace->headings;
  result.cost = trace->cost;
  result.cost_history = {{result.timings.plan, 0, trace->cost}};
  return result;
}

}  // namespace lrrt::bench
