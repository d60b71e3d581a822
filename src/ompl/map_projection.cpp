// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/ompl/map_projection.hpp"

#include <ompl/base/spaces/RealVectorStateSpace.h>

namespace lrrt {

using PlaneState = ompl::base::RealVectorStateSpace::StateType;

Eigen::Vector2d PlaneProjection::read(const ompl::base::State* state) const {
  const double* values = state->as<PlaneState>()->values;
  return {values[0], values[1]};
}

void PlaneProjection::write(const Eigen::Vector2d& position, ompl::base::State* state) const {
  double* values = state->as<PlaneState>()->values;
  values[0] = position.x();
  values[1] = position.y();
}

}  // namespace lrrt
