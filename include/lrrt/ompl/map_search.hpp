// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/SpaceInformation.h>

#include <memory>

#include "lrrt/ompl/guided_sampler.hpp"
#include "lrrt/ompl/map_validity.hpp"
#include "lrrt/ompl/planners.hpp"
#include "lrrt/ompl/search_limits.hpp"
#include "lrrt/plan.hpp"

namespace lrrt {

/// One search of an OMPL planner in the plane of a map: exact collision checks, guided samples, own termination.
class MapSearch {
 public:
  /// @param start,goal map units, both free. @param options with a range above 0, see suitable_range().
  MapSearch(std::shared_ptr<const CollisionMap> map, const Eigen::Vector2d& start, const Eigen::Vector2d& goal,
            MixedSampler sampler, const PlanOptions& options, CancelToken cancel);

  /// Call once. Runs until a path is good enough or a limit is reached; fills status, path, cost, counters and history
  /// of the result.
  void run(PlanResult& result);

 private:
  void record_costs(PlanResult& result);
  ompl::base::Cost target_cost() const;
  double reference_cost() const;
  void read_path(PlanResult& result) const;
  void read_tree(PlanResult& result) const;

  std::shared_ptr<const CollisionMap> map_;
  Eigen::Vector2d start_;
  Eigen::Vector2d goal_;
  PlanOptions options_;
  std::shared_ptr<PlaneProjection> projection_;
  std::shared_ptr<SearchLimits> limits_;
  ompl::base::SpaceInformationPtr si_;
  ompl::base::ProblemDefinitionPtr problem_;
  std::shared_ptr<GuidedSource> source_;
  MapPlanner planner_;
};

}  // namespace lrrt
