// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/StateValidityChecker.h>

#include <memory>
#include <utility>

#include "lrrt/map/swept_footprint.hpp"
#include "lrrt/ompl/map_validity.hpp"
#include "lrrt/ompl/pose_motion.hpp"
#include "lrrt/ompl/search_limits.hpp"

namespace lrrt {

/// A robot with an outline on a map, made ready for collision checks. Safe to share between threads.
class CollisionBody {
 public:
  /// @param map not inflated, but for a margin that the robot shall keep.
  CollisionBody(std::shared_ptr<const CollisionMap> map, Polygon outline)
      : map_(std::move(map)), walk_(map_->map(), map_->field(), std::move(outline)) {}
  CollisionBody(const CollisionBody&) = delete;
  CollisionBody& operator=(const CollisionBody&) = delete;

  /// The map.
  const std::shared_ptr<const CollisionMap>& map() const { return map_; }
  /// The robot's outline.
  const Polygon& outline() const { return walk_.polygon(); }
  /// True when the robot touches nothing at a pose.
  bool is_free(const Pose2& pose) const { return walk_.is_free(pose); }
  /// True when the robot touches nothing along a motion, or along its part up to a t in [0, 1]. A motion that comes
  /// nearer to something than the tolerance of FootprintWalk may be refused; one whose curve misses its end is.
  bool is_free(const PoseMotion& motion, double until = 1.0) const;

 private:
  std::shared_ptr<const CollisionMap> map_;
  FootprintWalk walk_;
};

/// OMPL's view of CollisionBody::is_free for the states of SE2StateSpace and those that derive from it.
class PoseValidityChecker final : public ompl::base::StateValidityChecker {
 public:
  /// @param body robot and map.
  PoseValidityChecker(const ompl::base::SpaceInformationPtr& si, std::shared_ptr<const CollisionBody> body);
  /// True when the robot touches nothing at the state's pose.
  bool isValid(const ompl::base::State* state) const override;
  /// Distance to the nearest obstacle, map units: a lower bound of it, never negative.
  double clearance(const ompl::base::State* state) const override;

 private:
  std::shared_ptr<const CollisionBody> body_;
};

/// OMPL's view of CollisionBody::is_free for the motions of SE2StateSpace, DubinsStateSpace and ReedsSheppStateSpace:
/// free at every moment, where OMPL's own checks sample the motion. Motions are checked from their first state to their
/// second one; in the Dubins space that is not the same as back.
class PoseMotionValidator final : public ompl::base::MotionValidator {
 public:
  /// @param limits when given, no motion is free any more once they say that the search must end.
  /// @throws RequestError when the space is none of the three.
  PoseMotionValidator(const ompl::base::SpaceInformationPtr& si, std::shared_ptr<const CollisionBody> body,
                      std::shared_ptr<SearchLimits> limits = nullptr);
  /// True when the robot touches nothing along the motion.
  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to) const override;
  /// Also finds the last free state, by bisection.
  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to,
                   std::pair<ompl::base::State*, double>& last_valid) const override;

 private:
  std::shared_ptr<const CollisionBody> body_;
  Steering steering_;
  std::shared_ptr<SearchLimits> limits_;
};

}  // namespace lrrt
