// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/ompl/guided_objective.hpp"

#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/SpaceInformation.h>

#include <algorithm>
#include <utility>

namespace lrrt {

namespace ob = ompl::base;

namespace {

/// Tries for a state that could shorten the path. AIT* would allow four thousand million, and where the path is the
/// straight line none fits: it then looks at no clock for minutes.
constexpr unsigned int most_attempts = 1000;

}  // namespace

GuidedInformedSampler::GuidedInformedSampler(const ob::ProblemDefinitionPtr& problem, unsigned int attempts,
                                             ob::InformedSamplerPtr inner, std::shared_ptr<GuidedSource> source,
                                             std::optional<double> goal_slack)
    : ob::InformedSampler(problem, attempts),
      inner_(std::move(inner)),
      source_(std::move(source)),
      goal_slack_(source_->places_whole_states() ? goal_slack : std::nullopt),
      other_coordinates_(space_->allocDefaultStateSampler()) {}

bool GuidedInformedSampler::sampleUniform(ob::State* state, const ob::Cost& most) {
  if (source_->ended(*space_, state) || guided(state, nullptr, most)) return true;
  return goal_slack_ ? uniform(state, nullptr, most) : inner_->sampleUniform(state, most);
}

bool GuidedInformedSampler::sampleUniform(ob::State* state, const ob::Cost& least, const ob::Cost& most) {
  if (source_->ended(*space_, state) || guided(state, &least, most)) return true;
  return goal_slack_ ? uniform(state, &least, most) : inner_->sampleUniform(state, least, most);
}

bool GuidedInformedSampler::fits(const ob::State* state, const ob::Cost* least, const ob::Cost& most) const {
  if (least == nullptr && !opt_->isFinite(most)) return true;
  const ob::Cost cost = heuristicSolnCost(state);
  const bool may_improve = !opt_->isFinite(most) || opt_->isCostBetterThan(cost, most);
  // planners count their least costs from the goal itself
  return may_improve && (least == nullptr || !opt_->isCostBetterThan(inner_->heuristicSolnCost(state), *least));
}

bool GuidedInformedSampler::guided(ob::State* state, const ob::Cost* least, const ob::Cost& most) {
  const bool wanted = source_->wants_guided();
  for (unsigned int attempt = 0; wanted && attempt < numIters_; ++attempt) {
    source_->place_guided(state, *other_coordinates_);
    if (!fits(state, least, most)) continue;
    source_->count(true);
    return true;
  }
  source_->count(false);
  return false;
}

/// Leaves a state that was drawn even where none of them fits: some planners take it unasked.
bool GuidedInformedSampler::uniform(ob::State* state, const ob::Cost* least, const ob::Cost& most) {
  for (unsigned int attempt = 0; attempt < numIters_; ++attempt) {
    source_->place_informed(state, to_goal_itself(most).value());
    if (fits(state, least, most)) return true;
  }
  return false;
}

GuidedObjective::GuidedObjective(ob::OptimizationObjectivePtr inner, std::shared_ptr<GuidedSource> source,
                                 std::optional<LengthQuery> query)
    : ob::OptimizationObjective(inner->getSpaceInformation()),
      inner_(std::move(inner)),
      source_(std::move(source)),
      query_(query) {
  description_ = inner_->getDescription();
  setCostThreshold(inner_->getCostThreshold());
  if (inner_->hasCostToGoHeuristic()) {
    setCostToGoHeuristic([own = inner_, source = source_](const ob::State* state, const ob::Goal* goal) {
      return source->over() ? own->identityCost() : own->costToGo(state, goal);
    });
  }
}

ob::InformedSamplerPtr GuidedObjective::allocInformedStateSampler(const ob::ProblemDefinitionPtr& problem,
                                                                  unsigned int attempts) const {
  attempts = std::min(attempts, most_attempts);
  const auto slack = query_ ? std::optional<double>(query_->goal_slack) : std::nullopt;
  return std::make_shared<GuidedInformedSampler>(problem, attempts,
                                                 inner_->allocInformedStateSampler(problem, attempts), source_, slack);
}

}  // namespace lrrt
