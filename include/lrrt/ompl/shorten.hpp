// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/geometric/PathGeometric.h>

#include <cstdint>

namespace lrrt {

/// Shortens a path by OMPL's PathSimplifier, that is by shortcuts past its states and between points of its motions,
/// until that brings nothing or `stop` says so. The first and the last state stay. What is left of a motion that a
/// shortcut cut is not checked again.
/// @param seed of the random shortcuts, not 0.
void shorten(ompl::geometric::PathGeometric& path, const ompl::base::PlannerTerminationCondition& stop,
             std::uint32_t seed);

}  // namespace lrrt
