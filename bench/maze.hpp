// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "lrrt/map/components.hpp"
#include "lrrt/map/occupancy_map.hpp"
#include "lrrt/sampling/random.hpp"

namespace lrrt::bench {

/// How the spanning tree of a maze's cells is drawn.
enum class MazeAlgorithm {
  dfs,     ///< depth first with random turns: long winding corridors
  prim,    ///< a random edge of the frontier: many short dead ends
  wilson,  ///< loop-erased random walks (Wilson 1996): every spanning tree equally likely
};

/// Words for the algorithms, in the order of the enumeration.
const std::vector<std::string>& maze_algorithm_names();

/// A perfect maze: one way between any two cells. Cells lie at odd rows and columns, walls all around.
/// @param level blocks a side, odd, at least 5.
/// @return a map of level × level pixels, one a block.
OccupancyMap perfect_maze(int level, MazeAlgorithm algorithm, Random& random);

/// The maze with loops: about a share of its dead ends get a second exit.
OccupancyMap braided(const OccupancyMap& maze, double share, Random& random);

/// A maze drawn on a square picture: whole pixels a block, centred, blocked around.
/// @param pixels side of the picture, at least one a block.
OccupancyMap drawn(const OccupancyMap& maze, int pixels);

/// Centre of a block of a maze in pixel coordinates of its picture.
Eigen::Vector2d drawn_center(const OccupancyMap& maze, Pixel block, int pixels);

/// Number of the largest component, the first of those. @throws MapError when no pixel is free.
int largest_component(const Components& components);

/// The pixels of a component, row by row.
std::vector<Pixel> pixels_of(const Components& components, int label);

/// The ends of a long way: the free pixel farthest from any one in the largest component, and the one farthest from it,
/// counted in steps to the four neighbours. In a perfect maze, the longest way there is.
/// @throws MapError when no pixel is free.
std::pair<Pixel, Pixel> farthest_pixels(const OccupancyMap& map);

}  // namespace lrrt::bench
