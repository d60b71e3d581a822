// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lrrt/map/occupancy_map.hpp"
#include "lrrt/sampling/random.hpp"

namespace lrrt {

/// The points of a map over which a path could be shorter than the best known one, walls counted.
///
/// Informed sampling (Gammell, Srinivasa, Barfoot 2014) asks whether the straight lines from start to a point and on to
/// the goal are short enough; among walls nearly every point of the map passes. Here it is the walking distance inside
/// free space, for every pixel, by one flood from either end. Ways of any kind are in it, also those that lead round an
/// obstacle on the other side than the known path.
class ShortWays {
 public:
  /// @param start,goal free pixels that are joined. @param length of the best path, pixels; may be infinite.
  /// @throws RequestError when start and goal are not joined.
  ShortWays(const OccupancyMap& map, Pixel start, Pixel goal, double length);

  /// A better path is known: only pixels over which one shorter than this could lead. Takes constant time.
  void limit(double length);
  /// A random point of one of these pixels, pixel coordinates. Allocates nothing.
  Eigen::Vector2d draw(Random& random) const;
  /// Number of these pixels.
  std::size_t size() const { return count_; }

 private:
  std::int32_t shortest_ = 0;       ///< counted steps of the shortest way of all
  std::vector<Pixel> pixels_;       ///< by the length of the shortest way over them
  std::vector<std::size_t> first_;  ///< first_[n]: index of the first pixel whose way is at least n steps longer
  std::size_t count_ = 0;           ///< pixels in question, the first so many
};

}  // namespace lrrt
