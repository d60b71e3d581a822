// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/ompl/map_validity.hpp"

#include <ompl/base/SpaceInformation.h>

#include <algorithm>
#include <cmath>

namespace lrrt {

MapValidityChecker::MapValidityChecker(const ompl::base::SpaceInformationPtr& si,
                                       std::shared_ptr<const CollisionMap> map,
                                       std::shared_ptr<const MapProjection> projection)
    : ompl::base::StateValidityChecker(si), map_(std::move(map)), projection_(std::move(projection)) {}

bool MapValidityChecker::isValid(const ompl::base::State* state) const {
  return map_->is_free(projection_->read(state));
}

double MapValidityChecker::clearance(const ompl::base::State* state) const {
  const Pixel pixel = OccupancyMap::pixel_of(map_->map().to_pixel(projection_->read(state)));
  // The field measures between centres; the state and the obstacle's nearest point are at most half a diagonal off
  // each.
  const double pixels = std::max(0.0, static_cast<double>(map_->field().at(pixel)) - std::sqrt(2.0));
  return pixels * map_->map().resolution();
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
  double free = 0.0;
  double blocked = 1.0;
  for (int i = 0; i < 30; ++i) {
    const double middle = (free + blocked) / 2.0;
    (map_->is_free(start, start + middle * motion) ? free : blocked) = middle;
  }
  last_valid.second = free;
  if (last_valid.first != nullptr) si_->getStateSpace()->interpolate(from, to, free, last_valid.first);
  return false;
}

}  // namespace lrrt
