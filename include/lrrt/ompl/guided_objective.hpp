// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/samplers/InformedStateSampler.h>

#include <memory>
#include <optional>

#include "lrrt/ompl/guided_sampler.hpp"

namespace lrrt {

/// A query with one start and one goal state, and paths that cost their length at least.
struct LengthQuery {
  double goal_slack = 0.0;  ///< how much nearer than the goal itself a path may end
  double shortest = 0.0;    ///< no path is shorter
};

/// The guided source as OMPL's InformedSampler: with probability α a guided state over which a path could still be
/// shorter, otherwise a uniform one of them. For planners such as Informed RRT* and BIT*.
class GuidedInformedSampler final : public ompl::base::InformedSampler {
 public:
  /// @param inner the objective's own informed sampler: it knows least costs, and draws the uniform states where the
  /// source cannot. @param goal_slack see LengthQuery; nothing for other queries.
  GuidedInformedSampler(const ompl::base::ProblemDefinitionPtr& problem, unsigned int attempts,
                        ompl::base::InformedSamplerPtr inner, std::shared_ptr<GuidedSource> source,
                        std::optional<double> goal_slack);

  /// What OMPL asks, see ompl::base::InformedSampler.
  /// @{
  bool sampleUniform(ompl::base::State* state, const ompl::base::Cost& most) override;
  bool sampleUniform(ompl::base::State* state, const ompl::base::Cost& least, const ompl::base::Cost& most) override;
  bool hasInformedMeasure() const override { return inner_->hasInformedMeasure(); }
  double getInformedMeasure(const ompl::base::Cost& cost) const override {
    return inner_->getInformedMeasure(to_goal_itself(cost));
  }
  double getInformedMeasure(const ompl::base::Cost& least, const ompl::base::Cost& most) const override {
    return inner_->getInformedMeasure(least, to_goal_itself(most));
  }
  ompl::base::Cost heuristicSolnCost(const ompl::base::State* state) const override {
    return ompl::base::Cost(inner_->heuristicSolnCost(state).value() - goal_slack_.value_or(0.0));
  }
  /// @}

 private:
  /// What a path may cost that goes on to the goal itself: OMPL's informed samplers know no goal with an extent.
  ompl::base::Cost to_goal_itself(const ompl::base::Cost& cost) const {
    return ompl::base::Cost(cost.value() + goal_slack_.value_or(0.0));
  }
  bool guided(ompl::base::State* state, const ompl::base::Cost* least, const ompl::base::Cost& most);
  bool uniform(ompl::base::State* state, const ompl::base::Cost* least, const ompl::base::Cost& most);
  bool fits(const ompl::base::State* state, const ompl::base::Cost* least, const ompl::base::Cost& most) const;

  ompl::base::InformedSamplerPtr inner_;
  std::shared_ptr<GuidedSource> source_;
  std::optional<double> goal_slack_;  ///< a value where the source draws the uniform states
  ompl::base::StateSamplerPtr other_coordinates_;
};

/// Another objective, word for word, but for two things. It hands out the guided informed sampler: OMPL's informed
/// planners ask the objective for it and never the space. And a path as short as any can be, such as the straight line,
/// satisfies it: there is nothing left to search for, and nothing for informed samplers to draw. Once the search must
/// end its heuristics are 0, which is always true: OMPL's ordered sampler draws until a state could shorten the path,
/// without end where none can.
class GuidedObjective final : public ompl::base::OptimizationObjective {
 public:
  /// @param query nothing where costs are no lengths, or where there are several starts or another kind of goal.
  GuidedObjective(ompl::base::OptimizationObjectivePtr inner, std::shared_ptr<GuidedSource> source,
                  std::optional<LengthQuery> query);

  /// What OMPL asks, see ompl::base::OptimizationObjective.
  /// @{
  ompl::base::Cost stateCost(const ompl::base::State* state) const override { return inner_->stateCost(state); }
  ompl::base::Cost motionCost(const ompl::base::State* from, const ompl::base::State* to) const override {
    return inner_->motionCost(from, to);
  }
  ompl::base::Cost motionCostHeuristic(const ompl::base::State* from, const ompl::base::State* to) const override {
    if (source_->over()) return identityCost();
    // Distances are rounded: a bound above the true cost by the last bit lets BIT* prune a vertex of its own path, and
    // then read through its missing parent.
    return ompl::base::Cost((1.0 - 1e-5) * inner_->motionCostHeuristic(from, to).value());
  }
  bool isSatisfied(ompl::base::Cost cost) const override {
    constexpr double rounding = 1e-9;
    return inner_->isSatisfied(cost) || (query_ && cost.value() <= (1.0 + rounding) * query_->shortest);
  }
  bool isCostBetterThan(ompl::base::Cost a, ompl::base::Cost b) const override {
    return inner_->isCostBetterThan(a, b);
  }
  bool isCostEquivalentTo(ompl::base::Cost a, ompl::base::Cost b) const override {
    return inner_->isCostEquivalentTo(a, b);
  }
  bool isFinite(ompl::base::Cost cost) const override { return inner_->isFinite(cost); }
  ompl::base::Cost betterCost(ompl::base::Cost a, ompl::base::Cost b) const override {
    return inner_->betterCost(a, b);
  }
  ompl::base::Cost combineCosts(ompl::base::Cost a, ompl::base::Cost b) const override {
    return inner_->combineCosts(a, b);
  }
  ompl::base::Cost identityCost() const override { return inner_->identityCost(); }
  ompl::base::Cost infiniteCost() const override { return inner_->infiniteCost(); }
  ompl::base::Cost initialCost(const ompl::base::State* state) const override { return inner_->initialCost(state); }
  ompl::base::Cost terminalCost(const ompl::base::State* state) const override { return inner_->terminalCost(state); }
  bool isSymmetric() const override { return inner_->isSymmetric(); }
  ompl::base::Cost averageStateCost(unsigned int states) const override { return inner_->averageStateCost(states); }
  ompl::base::InformedSamplerPtr allocInformedStateSampler(const ompl::base::ProblemDefinitionPtr& problem,
                                                           unsigned int attempts) const override;
  void print(std::ostream& out) const override { inner_->print(out); }
  /// @}

 private:
  ompl::base::OptimizationObjectivePtr inner_;
  std::shared_ptr<GuidedSource> source_;
  std::optional<LengthQuery> query_;
};

}  // namespace lrrt
