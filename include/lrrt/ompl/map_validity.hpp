// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/StateValidityChecker.h>

#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "lrrt/map/clearance_bound.hpp"
#include "lrrt/map/distance_field.hpp"
#include "lrrt/map/occupancy_map.hpp"
#include "lrrt/map/segment_walk.hpp"
#include "lrrt/ompl/map_projection.hpp"
#include "lrrt/ompl/search_limits.hpp"

namespace lrrt {

/// A map made ready for collision checks: its frame, its distances and the walk over it. Safe to share between threads.
class CollisionMap {
 public:
  /// Unknown pixels count as obstacles, see OccupancyMap::resolved.
  explicit CollisionMap(OccupancyMap map) : CollisionMap(std::make_shared<const OccupancyMap>(std::move(map))) {}
  /// The same for a map that others hold, too. @param map not null.
  explicit CollisionMap(std::shared_ptr<const OccupancyMap> map) : map_(std::move(map)), bound_(*map_), walk_(bound_) {}
  CollisionMap(const CollisionMap&) = delete;
  CollisionMap& operator=(const CollisionMap&) = delete;

  /// The map.
  const OccupancyMap& map() const { return *map_; }
  /// The exact distances; computed when they are first asked for where motions are checked by a coarser bound.
  const DistanceField& field() const;
  /// What motions are checked by.
  const ClearanceBound& bound() const { return bound_; }
  /// True when a point, map units, is free.
  bool is_free(const Eigen::Vector2d& point) const { return walk_.is_free(map_->to_pixel(point)); }
  /// True when every pixel that a straight motion touches is free. @param from,to map units.
  bool is_free(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
    return walk_.is_free(map_->to_pixel(from), map_->to_pixel(to));
  }
  /// Distance from a point to the nearest obstacle, map units: a lower bound of it, never negative.
  double clearance(const Eigen::Vector2d& point) const;

 private:
  std::shared_ptr<const OccupancyMap> map_;
  ClearanceBound bound_;
  SegmentWalk walk_;
  mutable std::once_flag asked_;
  mutable std::optional<DistanceField> field_;
};

/// OMPL's view of CollisionMap::is_free for states.
class MapValidityChecker final : public ompl::base::StateValidityChecker {
 public:
  /// @param projection where a state stands on the map.
  MapValidityChecker(const ompl::base::SpaceInformationPtr& si, std::shared_ptr<const CollisionMap> map,
                     std::shared_ptr<const MapProjection> projection);
  /// True when the state's point is free.
  bool isValid(const ompl::base::State* state) const override;
  /// Distance to the nearest obstacle, map units: a lower bound of it, never negative.
  double clearance(const ompl::base::State* state) const override;

 private:
  std::shared_ptr<const CollisionMap> map_;
  std::shared_ptr<const MapProjection> projection_;
};

/// OMPL's view of CollisionMap::is_free for straight motions: exact, where OMPL's own check samples the motion and
/// skips thin walls.
class MapMotionValidator final : public ompl::base::MotionValidator {
 public:
  /// @param limits when given, no motion is free any more once they say that the search must end.
  MapMotionValidator(const ompl::base::SpaceInformationPtr& si, std::shared_ptr<const CollisionMap> map,
                     std::shared_ptr<const MapProjection> projection, std::shared_ptr<SearchLimits> limits = nullptr);
  /// True when every pixel that the motion touches is free.
  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to) const override;
  /// Also finds the last free state, by bisection.
  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to,
                   std::pair<ompl::base::State*, double>& last_valid) const override;

 private:
  std::shared_ptr<const CollisionMap> map_;
  std::shared_ptr<const MapProjection> projection_;
  std::shared_ptr<SearchLimits> limits_;
};

}  // namespace lrrt
