// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/ompl/clearance_objective.hpp"

#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>

#include <utility>

namespace lrrt {
namespace {

namespace ob = ompl::base;

bool drives_arcs(const ob::StateSpace& space) {
  return dynamic_cast<const ob::DubinsStateSpace*>(&space) != nullptr ||
         dynamic_cast<const ob::ReedsSheppStateSpace*>(&space) != nullptr;
}

}  // namespace

ClearanceObjective::ClearanceObjective(const ob::SpaceInformationPtr& si, std::shared_ptr<const CollisionMap> map,
                                       std::shared_ptr<const MapProjection> projection, const ClearanceCost& clearance)
    : ob::PathLengthOptimizationObjective(si),
      map_(std::move(map)),
      projection_(std::move(projection)),
      surcharge_(map_->map(), map_->field(), clearance) {
  description_ = "Path length and clearance";
  // without a body moments only depend on how far the reference point moves
  if (drives_arcs(*si->getStateSpace())) steering_.emplace(*si->getStateSpace(), 0.0);
}

bool ClearanceObjective::isSymmetric() const {
  return !steering_;
}

ob::Cost ClearanceObjective::motionCost(const ob::State* from, const ob::State* to) const {
  const OccupancyMap& map = map_->map();
  const double extra =
      steering_ ? along_arcs(steering_->between(from, to))
                : surcharge_.along(map.to_pixel(projection_->read(from)), map.to_pixel(projection_->read(to)));
  return ob::Cost(si_->distance(from, to) + extra);
}

double ClearanceObjective::along_arcs(const PoseMotion& motion) const {
  const OccupancyMap& map = map_->map();
  const auto pixel_at = [&](double t) {
    const Pose2 pose = motion.at(t);
    return map.to_pixel({pose.x, pose.y});
  };
  double sum = 0.0;
  Eigen::Vector2d from = pixel_at(0.0);
  for (const double t : motion.moments(map.resolution())) {
    const Eigen::Vector2d to = pixel_at(t);
    sum += surcharge_.along(from, to);
    from = to;
  }
  return sum;
}

}  // namespace lrrt
