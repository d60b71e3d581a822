// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/ompl/pose_validity.hpp"

#include <ompl/base/SpaceInformation.h>

#include <algorithm>
#include <utility>

#include "last_free.hpp"

namespace lrrt {
namespace {

/// OMPL's curves may miss their end by rounding, seldom by more: so much, in pixels, is let pass.
constexpr double most_miss = 1e-3;

}  // namespace

bool CollisionBody::is_free(const PoseMotion& motion, double until) const {
  if (motion.miss() > most_miss * map_->map().resolution()) return false;
  return walk_.is_free([&](double t) { return motion.at(until * t); }, until * motion.speed());
}

PoseValidityChecker::PoseValidityChecker(const ompl::base::SpaceInformationPtr& si,
                                         std::shared_ptr<const CollisionBody> body)
    : ompl::base::StateValidityChecker(si), body_(std::move(body)) {}

bool PoseValidityChecker::isValid(const ompl::base::State* state) const {
  return body_->is_free(pose_of(state));
}

double PoseValidityChecker::clearance(const ompl::base::State* state) const {
  const Pose2 pose = pose_of(state);
  return std::max(0.0, body_->map()->clearance({pose.x, pose.y}) - body_->outline().circumscribed_radius());
}

PoseMotionValidator::PoseMotionValidator(const ompl::base::SpaceInformationPtr& si,
                                         std::shared_ptr<const CollisionBody> body,
                                         std::shared_ptr<SearchLimits> limits)
    : ompl::base::MotionValidator(si),
      body_(std::move(body)),
      steering_(*si->getStateSpace(), body_->outline().circumscribed_radius()),
      limits_(std::move(limits)) {}

bool PoseMotionValidator::checkMotion(const ompl::base::State* from, const ompl::base::State* to) const {
  if (limits_ && limits_->interrupted_at_motion()) return false;
  const bool free = body_->is_free(steering_.between(from, to));
  ++(free ? valid_ : invalid_);
  return free;
}

bool PoseMotionValidator::checkMotion(const ompl::base::State* from, const ompl::base::State* to,
                                      std::pair<ompl::base::State*, double>& last_valid) const {
  if (checkMotion(from, to)) return true;
  const PoseMotion motion = steering_.between(from, to);
  last_valid.second = motion.share(last_free_share([&](double t) { return body_->is_free(motion, t); }));
  if (last_valid.first != nullptr) {
    si_->getStateSpace()->interpolate(from, to, last_valid.second, last_valid.first);
  }
  return false;
}

}  // namespace lrrt
