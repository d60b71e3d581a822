// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/ScopedState.h>
#include <ompl/geometric/PathGeometric.h>

#include <memory>
#include <optional>

#include "lrrt/ompl/guided_sampler.hpp"
#include "lrrt/ompl/planners.hpp"
#include "lrrt/ompl/search_limits.hpp"
#include "lrrt/ompl/search_space.hpp"
#include "lrrt/plan.hpp"

namespace lrrt {

/// One search of an OMPL planner over a map: exact collision checks, guided samples, own termination.
class MapSearch {
 public:
  /// @param start,goal both free; their headings count where the space has any, in [-π, π).
  /// @param options with a range above 0, see suitable_range(). @param limits those of the space's motion validator.
  MapSearch(SearchSpace space, const Pose2& start, const Pose2& goal, MapSampler sampler, const PlanOptions& options,
            std::shared_ptr<SearchLimits> limits);

  /// Call once. Runs until a path is good enough or a limit is reached; fills status, path, cost, counters and history
  /// of the result. @throws Error when OMPL's planner returns a path that is not free.
  void run(PlanResult& result);

 private:
  ompl::base::ScopedState<> state_at(const Pose2& pose) const;
  ompl::base::GoalPtr goal_region() const;
  MapPlanner planner() const;
  void record_costs(PlanResult& result);
  ompl::base::Cost target_cost() const;
  double reference_cost() const;
  double clearance_cost(const Eigen::Vector2d& start, const Eigen::Vector2d& goal) const;
  void read_path(PlanResult& result) const;
  /// A path that is shorter and still free, if one was found in time.
  std::optional<Trace> shortened(const ompl::geometric::PathGeometric& path) const;
  void read_tree(PlanResult& result) const;

  SearchSpace space_;
  Pose2 goal_;
  PlanOptions options_;
  std::shared_ptr<SearchLimits> limits_;
  ompl::base::ProblemDefinitionPtr problem_;
  std::shared_ptr<GuidedSource> source_;
  MapPlanner planner_;
};

}  // namespace lrrt
