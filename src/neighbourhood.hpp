// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "free_space.hpp"
#include "lrrt/plan.hpp"
#include "trail.hpp"

namespace lrrt {

/// A small part of a map on which to check and to plan pieces of a path: it costs by its own size, not by the map's.
class Neighbourhood {
 public:
  /// @param robot its map is the whole map. @param box the pixels that matter; those that the robot needs around them
  /// are taken along.
  Neighbourhood(const PlanRequest& robot, const PixelBox& box);
  Neighbourhood(const Neighbourhood&) = delete;
  Neighbourhood& operator=(const Neighbourhood&) = delete;

  /// True when a piece of a trail is free.
  bool is_free(const Pose2& from, const Pose2& to);
  /// A path from pose to pose, unguided. @param options its seed and its time limit count.
  /// @return nothing when there is none in this part of the map, or none was found.
  std::optional<PlanResult> plan(const Pose2& from, const Pose2& to, const PlanOptions& options,
                                 const CancelToken& cancel);

 private:
  OccupancyMap part_;
  PlanRequest robot_;  ///< on that part
  FreeSpace space_;
};

/// Farthest distance of a point of the robot from its reference point, map units.
double reach_of(const PlanRequest& robot);

}  // namespace lrrt
