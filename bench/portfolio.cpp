// SPDX-License-Identifier: BSD-3-Clause
#include "portfolio.hpp"

#include <ompl/base/ScopedState.h>
#include <ompl/geometric/planners/AnytimePathShortening.h>
#include <ompl/geometric/planners/kpiece/LBKPIECE1.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "lrrt/map/footprint.hpp"
#include "lrrt/ompl/search_space.hpp"
#include "rival.hpp"
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
  return pose_space(room, body_on(map, outline), motion, row.turning_radius * problem.scale,
                    outline.circumscribed_radius(), {}, nullptr);
}

ob::ScopedState<> state_of(const SearchSpace& space, const Pose2& pose) {
  ob::ScopedState<> state(space.si);
  space.projection->write({pose.x, pose.y}, state.get());
  if (space.projection->has_heading()) space.projection->write_heading(pose.yaw, state.get());
  return state;
}

std::shared_ptr<ob::ProblemDefinition> definition_of(const SearchSpace& space, const Problem& problem) {
  const auto definition = std::make_shared<ob::ProblemDefinition>(space.si);
  definition->setStartAndGoalStates(state_of(space, start_of(problem)), state_of(space, goal_of(problem)));
  space.objective->setCostThreshold(ob::Cost(std::numeric_limits<double>::infinity()));
  definition->setOptimizationObjective(space.objective);
  return definition;
}

std::shared_ptr<og::AnytimePathShortening> portfolio_of(const ob::SpaceInformationPtr& si, double range) {
  const auto made = og::AnytimePathShortening::createPlanner<og::RRTConnect, og::LBKPIECE1>(si);
  if (range > 0.0) {
    made->getPlanner(0)->as<og::RRTConnect>()->setRange(range);
    made->getPlanner(1)->as<og::LBKPIECE1>()->setRange(range);
  }
  return made;
}

/// The best of the paths found that is free, checked once more.
std::optional<Trace> best_free(const SearchSpace& space, const ob::ProblemDefinition& definition) {
  for (const ob::PlannerSolution& solution : definition.getSolutions()) {  // best first
    if (solution.approximate_) continue;
    if (std::optional<Trace> trace = space.tell(*solution.path_)) return trace;
  }
  return std::nullopt;
}

}  // namespace

PlanResult portfolio_search(const Problem& problem, const PlanSuite& suite, const PlanRow& row,
                            const CancelToken& cancel) {
  RivalRun run(row, cancel);
  const SearchSpace space = space_of(problem, suite, row);
  const auto blocked =
      blocked_end(problem, [&](const Pose2& pose) { return space.si->isValid(state_of(space, pose).get()); });
  if (blocked) return run.failed(*blocked);
  const auto definition = definition_of(space, problem);
  const auto planner = portfolio_of(space.si, row.options.range);
  planner->setProblemDefinition(definition);
  planner->setup();
  run.prepared();
  while (!run.over()) {
    planner->solve(ob::PlannerTerminationCondition([&] { return run.over(); }));
    if (const std::optional<Trace> trace = best_free(space, *definition))
      return run.solved(trace->points, trace->headings, trace->cost);
    definition->clearSolutionPaths();
    planner->clear();
  }
  return run.failed(PlanStatus::time_limit);
}

}  // namespace lrrt::bench
