// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/Planner.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace lrrt {

/// Parameters that every tree planner shares.
struct PlannerSettings {
  double range = 0.0;       ///< longest extension of the tree, map units; 0 leaves the planner's default
  double goal_bias = 0.05;  ///< share of iterations that aim at the goal (RRT and RRT*)
  std::uint32_t seed = 1;   ///< of the planner's own random numbers; not 0
  bool grid = true;         ///< see Neighbors::grid
};

/// An OMPL planner and what OMPL's common interface does not tell.
struct MapPlanner {
  ompl::base::PlannerPtr planner;      ///< without a problem yet
  std::function<std::size_t()> nodes;  ///< number of nodes in the tree, trees or roadmap
  /// To be called once an iteration where it is there: tells the problem of a better path, which a planner that keeps
  /// silent about it has found since.
  std::function<void()> announce{};
};

/// Names that make_planner() knows, as OMPL spells them. Two are missing because they take the process with them
/// in OMPL 1.5: LBTRRT recurses without end on some queries, BFMT reads a null pointer when time runs out.
const std::vector<std::string>& planner_names();

/// @throws RequestError for a name that make_planner() does not know; the text lists the known ones.
void check_planner_name(const std::string& name);

/// True for a planner that goes on after its first path to shorten it. @throws RequestError as check_planner_name().
bool shortens_its_path(const std::string& name);

/// True for a planner that reaches its goal only because some iterations aim at it. @throws RequestError as above.
bool needs_goal_bias(const std::string& name);

/// True for a planner that may plan where the way back is another one (Dubins): it checks every motion in the direction
/// in which its path uses it, and copes with distances that are not symmetric. @throws RequestError as above.
bool keeps_direction(const std::string& name);

/// True for a planner that may plan to a goal with an extent (PlanOptions::goal_tolerance). AIT* of OMPL 1.5 fails an
/// assertion there, which ends the process. @throws RequestError as above.
bool takes_goal_tolerance(const std::string& name);

/// Makes an OMPL planner by name. RRT* and its kin rewire within a shrinking disc (Karaman and Frazzoli 2011), as the
/// paper's does.
/// @throws RequestError as check_planner_name().
MapPlanner make_planner(const std::string& name, const ompl::base::SpaceInformationPtr& si,
                        const PlannerSettings& settings);

}  // namespace lrrt
