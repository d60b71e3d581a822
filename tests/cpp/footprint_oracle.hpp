// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "lrrt/map/occupancy_map.hpp"
#include "lrrt/sampling/random.hpp"

namespace lrrt::test {

/// A second opinion that shares nothing with the library but the map: the robot is cut into triangles by clipping ears,
/// and every triangle is held against every pixel that is not free, the ones around the map included.
class FootprintOracle {
 public:
  /// @param map must outlive this. @param vertices of a simple polygon, either way round, map units.
  FootprintOracle(const OccupancyMap& map, std::vector<Eigen::Vector2d> vertices);

  /// Whether the robot touches nothing at a pose.
  bool is_free(const Pose2& pose) const { return keeps(pose, 0.0); }
  /// Whether the robot is at least this far, in pixels, from everything that is not free; at 0, whether it touches
  /// nothing.
  bool keeps(const Pose2& pose, double distance) const;

 private:
  std::vector<Eigen::Vector2d> placed(const Pose2& pose) const;
  void clip_ears();
  bool is_ear(const std::vector<std::size_t>& left, std::size_t i) const;
  bool touches(const std::vector<Eigen::Vector2d>& corners, int c, int r) const;

  const OccupancyMap& map_;
  std::vector<Eigen::Vector2d> vertices_;
  std::vector<std::array<std::size_t, 3>> triangles_;
};

/// A random simple polygon, seldom convex, either way round; the reference point may lie outside. @param size map
/// units.
std::vector<Eigen::Vector2d> random_vertices(Random& random, double size);

}  // namespace lrrt::test
