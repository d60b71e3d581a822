// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lrrt/map/occupancy_map.hpp"

namespace lrrt {

/// One problem of a MovingAI scenario file.
struct Scenario {
  int bucket = 0;               ///< difficulty class: problems of similar optimal length share it
  std::string map;              ///< path of the map as written in the file
  int width = 0;                ///< map width that the problem was made for
  int height = 0;               ///< map height that the problem was made for
  Pixel start;                  ///< column and row, (0, 0) at the top left
  Pixel goal;                   ///< column and row
  double optimal_length = 0.0;  ///< pixels, 8-connected with √2 diagonals that do not cut corners
};

/// Parses a MovingAI grid map (`type octile`; Sturtevant 2012, "Benchmarks for Grid-Based Pathfinding").
///
/// `.`, `G` and `S` (ground, swamp) are free; `@`, `O`, `T` and `W` (out of bounds, trees, water) are occupied. The map
/// is in pixels. Windows line ends and blank lines at the end are accepted.
/// @param source name of the file for error texts.
/// @throws MapError that names file and line: broken header, row of another length, unknown character, missing rows.
OccupancyMap parse_moving_ai_map(const std::string& text, const std::string& source);

/// Parses a MovingAI scenario list (version 1).
/// @throws MapError that names file and line: other version, wrong number of fields, wrong numbers, points off the map.
std::vector<Scenario> parse_scenarios(const std::string& text, const std::string& source);

/// Reads a `.map` file. @throws MapError as parse_moving_ai_map, and when the file cannot be read.
OccupancyMap read_moving_ai_map(const std::filesystem::path& path);

/// Reads a `.scen` file. @throws MapError as parse_scenarios, and when the file cannot be read.
std::vector<Scenario> read_scenarios(const std::filesystem::path& path);

}  // namespace lrrt
