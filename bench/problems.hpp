// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "json.hpp"
#include "lrrt/map/occupancy_map.hpp"
#include "suite.hpp"

namespace lrrt::bench {

/// One query on one map.
struct Problem {
  std::string group;  ///< name of the suite's entry that the map came from
  std::string map_name;
  std::shared_ptr<const OccupancyMap> map;
  std::string query;
  Eigen::Vector2d start;       ///< map units
  Eigen::Vector2d goal;        ///< map units
  double start_heading = 0.0;  ///< radians; 0 where nothing has a heading
  double goal_heading = 0.0;   ///< the same
  double scale = 1.0;          ///< what the robot's lengths are multiplied by
};

/// Reads or makes every map of a suite and draws its queries. The same suite gives the same problems.
/// @throws SuiteError when a path holds nothing or a map has no room for the robot. @throws MapError for a broken map.
std::vector<Problem> make_problems(const Suite& suite);

/// A checksum of size and cells.
std::string map_checksum(const OccupancyMap& map);

}  // namespace lrrt::bench
