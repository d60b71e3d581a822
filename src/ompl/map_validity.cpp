// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/ompl/map_validity.hpp"

#include <ompl/base/SpaceInformation.h>

#include <algorithm>
#include <cmath>

#include "last_free.hpp"

namespace lrrt {

const DistanceField& CollisionMap::field() const {
  if (bound_.coarseness() == 1) return bound_.field();
  std::call_once(asked_, [this] { field_.emplace(*map_); });
  return *field_;
}

double CollisionMap::clearance(const Eigen::Vector2d& point) const {
  // The bound is one between centres; the point and the obstacle's nearest one are at most half a diagonal off each.
  const double pixels = static_cast<double>(bound_.at(OccupancyMap::pixel_of(map_->to_pixel(point)))) - std::sqrt(2.0);
  return std::max(0.0, pixels) * map_->resolution();
}

MapValidityChecker::MapValidityChecker(const ompl::base::SpaceInformationPtr& si,
                                       std::shared_ptr<const CollisionMap> map,
                                       std::shared_ptr<const MapProjection> projection)
    : ompl::base::StateValidityChecker(si), map_(std::move(map)), projection_(std::move(projection)) {}

bool MapValidityChecker::isValid(const ompl::base::State* state) const {
  return map_->is_free(projection_->read(state));
}

double MapValidityChecker::clearance(const ompl::base::State* state) const {
  return map_->clearance(projection_->read(state));
}

MapMotionValidator::MapMotionValidator(const ompl::base::SpaceInformationPtr& si,
                                       std::shared_ptr<const CollisionMap> map,
                                       std::shared_ptr<const MapProjection> projection,
                                       std::shared_ptr<SearchLimits> limits)
    : ompl::base::MotionValidator(si),
      map_(std::move(map)),
      projection_(std::move(projection)),
      limits_(std::move(limits)) {}

bool MapMotionValidator::checkMotion(const ompl::base::State* from, const ompl::base::State* to) const {
  if (limits_ && limits_->interrupted_at_motion()) return false;
  const bool free = map_->is_free(projection_->read(from), projection_->read(to));
  ++(free ? valid_ : invalid_);
  return free;
}

bool MapMotionValidator::checkMotion(const ompl::base::State* from, const ompl::base::State* to,
                                     std::pair<ompl::base::State*, double>& last_valid) const {
  if (checkMotion(from, to)) return true;
  const Eigen::Vector2d start = projection_->read(from);
  const Eigen::Vector2d motion = projection_->read(to) - start;
  last_valid.second = last_free_share([&](double share) { return map_->is_free(start, start + share * motion); });
  if (last_valid.first != nullptr) {
    si_->getStateSpace()->interpolate(from, to, last_valid.second, last_valid.first);
  }
  return false;
}

}  // namespace lrrt
