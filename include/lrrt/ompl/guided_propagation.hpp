// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/StateValidityChecker.h>
#include <ompl/control/SpaceInformation.h>
#include <ompl/control/StatePropagator.h>

#include <memory>

#include "lrrt/ompl/guided_sampler.hpp"

namespace lrrt {

/// Tells a source of the steps of OMPL's control planners that are free: those planners ask no motion validator, but
/// propagate a state and then ask whether the result is valid. From now on both questions are listened to; who answers
/// them stays the same. @throws RequestError when there is no state propagator.
void observe_propagation(ompl::control::SpaceInformation& si, const std::shared_ptr<GuidedSource>& source);

}  // namespace lrrt
