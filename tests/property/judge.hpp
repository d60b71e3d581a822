// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "query.hpp"

namespace lrrt::property {

/// All that must hold of the answer to a query, found by code that shares nothing with the planner.
/// @return what does not hold; empty when all does.
std::string judge(const Query& query, const PlanResult& result);

/// The part of judge() for a path in the plane: every segment, against every pixel that is not free, and point by
/// point.
std::string judge_path(const Query& query, const PlanResult& result);

/// The part of judge() for a path of poses: the outline, at every pose and at ten in between, against every pixel that
/// is not free; whether the robot can drive so.
std::string judge_poses(const Query& query, const PlanResult& result);

/// The part of judge() for what is said of the ends of a path of poses, and of their being joined.
std::string judge_pose_status(const Query& query, PlanStatus status);

/// What two answers to one query do not share though they should; empty when nothing.
std::string compare(const PlanResult& one, const PlanResult& other);

}  // namespace lrrt::property
