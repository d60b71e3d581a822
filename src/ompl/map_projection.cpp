// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/ompl/map_projection.hpp"

#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>

#include <cmath>

namespace lrrt {

using PlaneState = ompl::base::RealVectorStateSpace::StateType;
using PoseState = ompl::base::SE2StateSpace::StateType;

double wrapped_angle(double angle) {
  constexpr double pi = 3.141592653589793;
  if (angle >= -pi && angle < pi) return angle;
  const double turned = std::remainder(angle, 2.0 * pi);
  return turned >= pi ? -pi : turned;
}

double angle_between(double a, double b) {
  return std::abs(wrapped_angle(a - b));
}

Eigen::Vector2d PlaneProjection::read(const ompl::base::State* state) const {
  const double* values = state->as<PlaneState>()->values;
  return {values[0], values[1]};
}

void PlaneProjection::write(const Eigen::Vector2d& position, ompl::base::State* state) const {
  double* values = state->as<PlaneState>()->values;
  values[0] = position.x();
  values[1] = position.y();
}

Eigen::Vector2d PoseProjection::read(const ompl::base::State* state) const {
  const auto* pose = state->as<PoseState>();
  return {pose->getX(), pose->getY()};
}

void PoseProjection::write(const Eigen::Vector2d& position, ompl::base::State* state) const {
  state->as<PoseState>()->setXY(position.x(), position.y());
}

double PoseProjection::read_heading(const ompl::base::State* state) const {
  return state->as<PoseState>()->getYaw();
}

void PoseProjection::write_heading(double angle, ompl::base::State* state) const {
  state->as<PoseState>()->setYaw(wrapped_angle(angle));
}

std::shared_ptr<const MapProjection> projection_of(const ompl::base::StateSpace& space) {
  namespace ob = ompl::base;
  if (dynamic_cast<const ob::SE2StateSpace*>(&space) == nullptr) return std::make_shared<PlaneProjection>();
  return std::make_shared<PoseProjection>(dynamic_cast<const ob::DubinsStateSpace*>(&space) == nullptr);
}

}  // namespace lrrt
