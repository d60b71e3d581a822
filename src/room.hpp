// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "lrrt/map/flood.hpp"
#include "lrrt/ompl/map_validity.hpp"

namespace lrrt {

/// Where the reference point of a robot may be: a map whose free pixels leave room for it, and what queries ask of it.
/// Parts are made when they are first asked for, and kept. Not for concurrent use.
class Room {
 public:
  /// @param map without unknown pixels. @param detail longest side, pixels, of the maps that joining() prefers.
  Room(std::shared_ptr<const OccupancyMap> map, int detail);
  Room(const std::shared_ptr<const CollisionMap>& map, int detail);

  const OccupancyMap& map() const { return *map_; }
  /// The map in the largest pixels on which start and goal are still free and joined; on larger pixels than needed for
  /// the detail it never is. Null when they are not joined on the map itself: then no path exists.
  /// @param start,goal map units.
  std::shared_ptr<const OccupancyMap> joining(const Eigen::Vector2d& start, const Eigen::Vector2d& goal);
  /// The map made ready for collision checks.
  const std::shared_ptr<const CollisionMap>& collision();

 private:
  /// The map in pixels of one size, and the components that were asked for.
  struct Level {
    std::shared_ptr<const OccupancyMap> map;
    std::vector<Flood> floods;

    bool joins(const Eigen::Vector2d& start, const Eigen::Vector2d& goal);
  };

  std::shared_ptr<const OccupancyMap> map_;
  std::shared_ptr<const CollisionMap> collision_;
  int coarsest_;               ///< factor of the first level
  std::vector<Level> levels_;  ///< each half as coarse as the one before
};

}  // namespace lrrt
