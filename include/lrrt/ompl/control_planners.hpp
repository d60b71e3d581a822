// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/control/SpaceInformation.h>

#include <string>
#include <vector>

#include "lrrt/ompl/planners.hpp"

namespace lrrt {

/// Names that make_control_planner() knows, as OMPL spells them. Each of them is a name of planner_names() too: of the
/// planner's kin that plans without controls.
const std::vector<std::string>& control_planner_names();

/// @throws RequestError for a name that make_control_planner() does not know; the text lists the known ones.
void check_control_planner_name(const std::string& name);

/// Makes a planner of ompl::control by name. OMPL has others that cannot be guided, since they ask for no samples
/// (KPIECE1) or decompose the map by themselves (Syclop).
/// @throws RequestError as above.
MapPlanner make_control_planner(const std::string& name, const ompl::control::SpaceInformationPtr& si,
                                const PlannerSettings& settings);

}  // namespace lrrt
