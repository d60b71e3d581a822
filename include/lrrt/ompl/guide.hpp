// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/Planner.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "lrrt/ompl/guided_sampler.hpp"
#include "lrrt/ompl/map_projection.hpp"
#include "lrrt/ompl/map_validity.hpp"
#include "lrrt/plan.hpp"
#include "lrrt/sampling/frontier.hpp"

namespace lrrt {

/// How to guide a planner.
struct GuideOptions {
  Strategy strategy = Strategy::frontier;  ///< where guided samples come from; not uniform
  double alpha = 0.8;                      ///< share of guided samples, 0 to 1; 1 gives up completeness
  double range = 0.0;                      ///< longest extension of the planner's tree, map units; 0 chooses by the map
  std::uint64_t seed = 1;                  ///< of the guided samples
};

/// Names of the planners that guide() knows how to guide, as OMPL spells them (Planner::getName).
std::vector<std::string> guidable_planners();

/// How a planner uses its samples, by its name. @throws RequestError for a planner that guide() cannot guide.
Growth growth_of(const std::string& planner);

/// The sampler of a strategy over a region, bridged where it has gaps.
/// @param map the one that the region was predicted for. @param start,goal map units, on free pixels of the map and
/// joined by free ones. @param options with a range above 0.
/// @throws RequestError when the region's size is not the map's.
MapSampler make_sampler(const std::shared_ptr<const OccupancyMap>& map, const PromisingRegion& region,
                        const Eigen::Vector2d& start, const Eigen::Vector2d& goal, Growth growth,
                        const GuideOptions& options);

/// Makes a planner of any OMPL set-up draw from a promising region, whatever way it asks for samples: the sampler
/// allocators of its space information, the informed sampler of its objective, the motions and the better paths that
/// tell the strategy how far the tree has come. Everything else of the set-up stays as it is, but that a path which
/// is as short as any can be (the straight line, where the objective is the length) ends the search.
///
/// The planner must have its problem (start, goal, objective if any) and must not be set up yet. Where the problem has
/// no objective, it gets that of the path's length, OMPL's own default. Start and goal stay what they are: other ones
/// need a planner and a problem of their own.
///
/// @param map where the robot's reference point may be: for a robot with a body, inflated by what it needs at least.
/// @param region of the same map, or of the map coarsened. @param projection how the planner's states touch the map; by
/// default projection_of() its space.
/// @return the source of the samples; its counts tell how many were guided.
/// @throws RequestError for a planner that cannot be guided (it would plan unguided without a word), that is set up
/// already or has no problem, and for a start or goal that does not lie on a free pixel of the map.
std::shared_ptr<GuidedSource> guide(ompl::base::Planner& planner, const std::shared_ptr<const CollisionMap>& map,
                                    const PromisingRegion& region, const GuideOptions& options = {},
                                    std::shared_ptr<const MapProjection> projection = nullptr);

/// The same for a sampler that exists already. @throws RequestError as above but for start and goal.
std::shared_ptr<GuidedSource> guide(ompl::base::Planner& planner, MapSampler sampler,
                                    const std::shared_ptr<const MapProjection>& projection);

}  // namespace lrrt
