// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/ompl/guide.hpp"

#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/base/goals/GoalState.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>

#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <typeinfo>
#include <utility>

#include "lrrt/error.hpp"
#include "lrrt/ompl/clearance_objective.hpp"
#include "lrrt/ompl/drive_space.hpp"
#include "lrrt/ompl/guided_objective.hpp"
#include "lrrt/ompl/guided_propagation.hpp"
#include "lrrt/ompl/suitable_range.hpp"

namespace lrrt {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

const std::map<std::string, Growth>& growths() {
  static const std::map<std::string, Growth> table = {
      {"RRT", Growth::one_tree},
      {"RRTConnect", Growth::two_trees},
      {"RRTstar", Growth::one_tree},
      {"RRTsharp", Growth::one_tree},
      {"RRTXstatic", Growth::one_tree},
      {"LBTRRT", Growth::one_tree},
      {"TRRT", Growth::one_tree},
      {"BiTRRT", Growth::two_trees},
      {"InformedRRTstar", Growth::one_tree},
      {"SORRTstar", Growth::batch},
      {"BITstar", Growth::batch},
      {"ABITstar", Growth::batch},
      {"AITstar", Growth::batch},
      {"FMT", Growth::batch},
      {"BFMT", Growth::batch},
      {"PRM", Growth::batch},
      {"PRMstar", Growth::batch},
      {"LazyPRM", Growth::batch},
      {"LazyPRMstar", Growth::batch},
      {"EST", Growth::one_tree},
      {"BiEST", Growth::two_trees},
      {"SST", Growth::one_tree},
  };
  return table;
}

/// OMPL has names of its own for a few: "RRT#", and "k…" for the versions that connect to the k nearest.
std::string plain_name(const std::string& name) {
  if (name == "RRT#") return "RRTsharp";
  return name.size() > 1 && name[0] == 'k' && growths().count(name.substr(1)) != 0 ? name.substr(1) : name;
}

Pixel free_pixel(const OccupancyMap& map, const Eigen::Vector2d& point, const char* what) {
  const Pixel pixel = OccupancyMap::pixel_of(map.to_pixel(point));
  if (map.is_free(pixel)) return pixel;
  std::ostringstream text;
  text << "the planner's " << what << " (" << point.x() << ", " << point.y()
       << ") does not lie on a free pixel of the map: give the map in which the planner's reference point moves";
  throw RequestError(text.str());
}

/// A state of the goal: the goal itself, or a sample of its region.
Eigen::Vector2d goal_position(const ob::ProblemDefinition& problem, const MapProjection& projection) {
  const auto* goal = dynamic_cast<const ob::GoalSampleableRegion*>(problem.getGoal().get());
  if (goal == nullptr || goal->maxSampleCount() == 0) {
    throw RequestError("the planner's goal cannot be sampled: guide() needs a goal state or a sampleable region");
  }
  const ob::SpaceInformationPtr& si = problem.getSpaceInformation();
  ob::State* state = si->allocState();
  goal->sampleGoal(state);
  Eigen::Vector2d position = projection.read(state);
  si->freeState(state);
  return position;
}

/// Users' own kinds of lengths may cost less than the straight line.
bool costs_length(const ob::OptimizationObjective& objective) {
  return typeid(objective) == typeid(ob::PathLengthOptimizationObjective) ||
         typeid(objective) == typeid(ClearanceObjective);
}

std::optional<LengthQuery> length_query(const ob::ProblemDefinition& problem,
                                        const ob::OptimizationObjective& objective) {
  const auto* goal = dynamic_cast<const ob::GoalState*>(problem.getGoal().get());
  if (!costs_length(objective) || goal == nullptr || problem.getStartStateCount() != 1) return std::nullopt;
  const double straight = problem.getSpaceInformation()->distance(problem.getStartState(0), goal->getState());
  return LengthQuery{goal->getThreshold(), straight - goal->getThreshold()};
}

/// The map that a region belongs to: this one, or it in larger pixels.
std::shared_ptr<const OccupancyMap> map_of(const PromisingRegion& region,
                                           const std::shared_ptr<const CollisionMap>& map) {
  const int factor = region.coarseness() / map->map().coarseness();
  if (factor > 1) return std::make_shared<const OccupancyMap>(map->map().coarsened(factor));
  return {map, &map->map()};
}

/// The greatest length, map units, of a way to the goal itself that begins with a path of some cost; infinite where the
/// cost tells nothing of it.
struct LengthBound {
  double per_cost = std::numeric_limits<double>::infinity();
  double slack = 0.0;

  double operator()(ob::Cost cost) const { return per_cost * cost.value() + slack; }
};

LengthBound length_bound(const ob::ProblemDefinition& problem, const ob::OptimizationObjective& objective) {
  const auto* duration = dynamic_cast<const DurationObjective*>(&objective);
  const auto* poses = dynamic_cast<const PoseGoal*>(problem.getGoal().get());
  if (duration != nullptr && poses != nullptr && problem.getStartStateCount() == 1) {
    return {duration->top_speed(), poses->tolerance()};
  }
  const std::optional<LengthQuery> query = length_query(problem, objective);
  return query ? LengthBound{1.0, query->goal_slack} : LengthBound{};
}

void check(const ob::Planner& planner) {
  growth_of(planner.getName());
  if (!planner.getProblemDefinition() || planner.getProblemDefinition()->getStartStateCount() == 0 ||
      !planner.getProblemDefinition()->getGoal()) {
    throw RequestError("planner " + planner.getName() + " has no problem yet: set start and goal, then guide it");
  }
  if (planner.isSetup()) {
    throw RequestError("planner " + planner.getName() +
                       " is set up already and keeps the samplers it has: guide it before setup()");
  }
}

}  // namespace

std::vector<std::string> guidable_planners() {
  std::vector<std::string> names;
  for (const auto& entry : growths()) names.push_back(entry.first);
  return names;
}

Growth growth_of(const std::string& planner) {
  const auto found = growths().find(plain_name(planner));
  if (found != growths().end()) return found->second;
  std::string known;
  for (const auto& entry : growths()) known += (known.empty() ? "" : ", ") + entry.first;
  throw RequestError("planner '" + planner + "' cannot be guided; these can: " + known);
}

MapSampler make_sampler(const std::shared_ptr<const OccupancyMap>& map, const PromisingRegion& region,
                        const Eigen::Vector2d& start, const Eigen::Vector2d& goal, Growth growth,
                        const GuideOptions& options) {
  const Pixel from = free_pixel(*map, start, "start");
  const Pixel to = free_pixel(*map, goal, "goal");
  region.check_belongs_to(*map);
  std::optional<PromisingRegion> mended;
  if (!region.connected()) mended = region.bridged(*map, from, to);
  const PromisingRegion& bridged = mended ? *mended : region;
  std::unique_ptr<SamplingStrategy> guided;
  if (options.strategy == Strategy::frontier && bridged.connected()) {
    guided = std::make_unique<FrontierStrategy>(map, bridged, from, to,
                                                FrontierOptions{options.range / map->resolution(), growth});
  } else if (options.strategy != Strategy::uniform && bridged.area() > 0) {
    guided = std::make_unique<RegionStrategy>(bridged);
  }
  return {map, {std::move(guided), UniformStrategy(map->width(), map->height()), options.alpha, options.seed}};
}

std::shared_ptr<GuidedSource> guide(ob::Planner& planner, const std::shared_ptr<const CollisionMap>& map,
                                    const PromisingRegion& region, const GuideOptions& options,
                                    std::shared_ptr<const MapProjection> projection) {
  check(planner);
  if (!projection) projection = projection_of(*planner.getSpaceInformation()->getStateSpace());
  const ob::ProblemDefinition& problem = *planner.getProblemDefinition();
  GuideOptions complete = options;
  if (complete.range == 0.0) complete.range = suitable_range(*map);
  return guide(planner,
               make_sampler(map_of(region, map), region, projection->read(problem.getStartState(0)),
                            goal_position(problem, *projection), growth_of(planner.getName()), complete),
               projection);
}

std::shared_ptr<GuidedSource> guide(ob::Planner& planner, MapSampler sampler,
                                    const std::shared_ptr<const MapProjection>& projection) {
  check(planner);
  const ob::SpaceInformationPtr si = planner.getSpaceInformation();
  const ob::ProblemDefinitionPtr problem = planner.getProblemDefinition();
  auto source =
      std::make_shared<GuidedSource>(std::move(sampler), projection, projection->read(problem->getStartState(0)),
                                     goal_position(*problem, *projection));
  si->getStateSpace()->setStateSamplerAllocator(
      [source](const ob::StateSpace* space) { return std::make_shared<GuidedStateSampler>(space, source); });
  si->setValidStateSamplerAllocator([source](const ob::SpaceInformation* information) {
    return std::make_shared<GuidedValidStateSampler>(information, source);
  });
  si->setMotionValidator(std::make_shared<ObservingMotionValidator>(si.get(), si->getMotionValidator(), source));
  if (auto* controlled = dynamic_cast<oc::SpaceInformation*>(si.get())) observe_propagation(*controlled, source);
  ob::OptimizationObjectivePtr objective = problem->getOptimizationObjective();
  if (!objective) objective = std::make_shared<ob::PathLengthOptimizationObjective>(si);
  problem->setOptimizationObjective(
      std::make_shared<GuidedObjective>(objective, source, length_query(*problem, *objective)));
  problem->setIntermediateSolutionCallback(
      [source, most_length = length_bound(*problem, *objective), theirs = problem->getIntermediateSolutionCallback()](
          const ob::Planner* solver, const std::vector<const ob::State*>& states, const ob::Cost cost) {
        source->improved(states, most_length(cost));
        if (theirs) theirs(solver, states, cost);
      });
  return source;
}

}  // namespace lrrt
