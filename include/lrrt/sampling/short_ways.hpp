// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "lrrt/map/occupancy_map.hpp"
#include "lrrt/region/geodesic.hpp"
#include "lrrt/sampling/random.hpp"

namespace lrrt {

/// The points of a map over which a path could be shorter than the best known one, walls counted.
///
/// Informed sampling (Gammell, Srinivasa, Barfoot 2014) asks whether the straight lines from start to a point and on to
/// the goal are short enough; among walls nearly every point of the map passes. Here it is the walking distance inside
/// free space, for every pixel, by one flood from either end. Ways that lead round an obstacle on the other side than
/// the known path are in it. Left out may be those through staircases one pixel wide, where steps to neighbours count
/// up to √2 times the length; ellipses hold them, so some draws should come from one.
class ShortWays {
 public:
  /// @param length of the best path, pixels; may be infinite. @return nothing when free pixels do not join start and
  /// goal.
  static std::optional<ShortWays> between(const OccupancyMap& map, Pixel start, Pixel goal, double length);

  /// A better path is known: only pixels over which one shorter than this could lead. Takes constant time.
  void limit(double length);
  /// A random point of one of these pixels, pixel coordinates. Allocates nothing.
  Eigen::Vector2d draw(Random& random) const;
  /// Number of these pixels.
  std::size_t size() const { return count_; }

 private:
  ShortWays(const Geodesic& from_start, const Geodesic& from_goal, std::int32_t shortest, double length);

  std::int32_t shortest_ = 0;       ///< counted steps of the shortest way of all
  std::vector<Pixel> pixels_;       ///< by the length of the shortest way over them
  std::vector<std::size_t> first_;  ///< first_[n]: index of the first pixel whose way is at least n steps longer
  std::size_t count_ = 0;           ///< pixels in question, the first so many
};

}  // namespace lrrt
