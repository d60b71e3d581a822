// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/ompl/search_space.hpp"

#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <algorithm>
#include <cmath>

namespace lrrt {
namespace {

namespace ob = ompl::base;

ob::RealVectorBounds bounds_of(const OccupancyMap& map) {
  const Bounds box = map.bounds();
  // A hair wider, so that a point on the map's edge is not lost to the rounding of its conversion.
  const double slack = 1e-9 * map.resolution();
  ob::RealVectorBounds bounds(2);
  for (unsigned int axis = 0; axis < 2; ++axis) {
    bounds.setLow(axis, box.low[axis] - slack);
    bounds.setHigh(axis, box.high[axis] + slack);
  }
  return bounds;
}

std::shared_ptr<ob::SE2StateSpace> poses(Motion motion, double turning_radius, double reach) {
  if (motion == Motion::dubins) return std::make_shared<ForwardSpace>(turning_radius);
  if (motion == Motion::reeds_shepp) return std::make_shared<ob::ReedsSheppStateSpace>(turning_radius);
  auto space = std::make_shared<ob::SE2StateSpace>();
  space->setSubspaceWeight(1, reach);  // OMPL's own is half a unit of length to a radian, whatever the unit
  return space;
}

/// Tells the motions of a pose space to a trace.
class PoseFollower {
 public:
  PoseFollower(ob::StateSpacePtr space, std::shared_ptr<const CollisionBody> body, double reach)
      : space_(std::move(space)),
        body_(std::move(body)),
        check_(*space_, body_->outline().circumscribed_radius()),
        steering_(*space_, reach) {}

  bool operator()(const ob::State* from, const ob::State* to, Trace& trace) const {
    if (body_->is_free(check_.between(from, to))) {
      append(steering_.between(from, to), false, trace);
      return true;
    }
    // Planners that take a motion for the same both ways may have checked the way back, which may be another curve of
    // the same length.
    if (!space_->hasSymmetricInterpolate() || !body_->is_free(check_.between(to, from))) return false;
    append(steering_.between(to, from), true, trace);
    return true;
  }

 private:
  void append(const PoseMotion& motion, bool backwards, Trace& trace) const {
    std::vector<double> moments = motion.moments(body_->map()->map().resolution());
    if (backwards) {
      moments.pop_back();
      std::reverse(moments.begin(), moments.end());
      moments.push_back(0.0);
    }
    for (const double t : moments) {
      const Pose2 pose = motion.at(t);
      trace.points.emplace_back(pose.x, pose.y);
      trace.headings.push_back(wrapped_angle(pose.yaw));
    }
  }

  ob::StateSpacePtr space_;
  std::shared_ptr<const CollisionBody> body_;
  Steering check_;
  Steering steering_;
};

}  // namespace

SearchSpace plane_space(const std::shared_ptr<const CollisionMap>& map, const std::shared_ptr<SearchLimits>& limits) {
  const auto projection = std::make_shared<const PlaneProjection>();
  auto space = std::make_shared<ob::RealVectorStateSpace>(2);
  space->setBounds(bounds_of(map->map()));
  const auto si = std::make_shared<ob::SpaceInformation>(space);
  si->setStateValidityChecker(std::make_shared<MapValidityChecker>(si, map, projection));
  si->setMotionValidator(std::make_shared<MapMotionValidator>(si, map, projection, limits));
  si->setup();
  const auto follow = [map, projection](const ob::State* from, const ob::State* to, Trace& trace) {
    const Eigen::Vector2d first = projection->read(from);
    const Eigen::Vector2d last = projection->read(to);
    if (!map->is_free(first, last) && !map->is_free(last, first)) return false;
    trace.points.push_back(last);
    return true;
  };
  return {map, projection, si, follow};
}

SearchSpace pose_space(const std::shared_ptr<const CollisionMap>& map, const std::shared_ptr<const CollisionBody>& body,
                       Motion motion, double turning_radius, double reach,
                       const std::shared_ptr<SearchLimits>& limits) {
  const std::shared_ptr<ob::SE2StateSpace> space = poses(motion, turning_radius, reach);
  space->setBounds(bounds_of(map->map()));
  const auto si = std::make_shared<ob::SpaceInformation>(space);
  si->setStateValidityChecker(std::make_shared<PoseValidityChecker>(si, body));
  si->setMotionValidator(std::make_shared<PoseMotionValidator>(si, body, limits));
  si->setup();
  return {map, projection_of(*space), si, PoseFollower(space, body, reach)};
}

}  // namespace lrrt
