// SPDX-License-Identifier: BSD-3-Clause
#include "room.hpp"

#include <algorithm>
#include <utility>

namespace lrrt {

Room::Room(std::shared_ptr<const OccupancyMap> map, int detail)
    : map_(std::move(map)), coarsest_(map_->coarsening_to(detail)) {}

Room::Room(const std::shared_ptr<const CollisionMap>& map, int detail)
    : Room(std::shared_ptr<const OccupancyMap>(map, &map->map()), detail) {
  collision_ = map;
}

bool Room::Level::joins(const Eigen::Vector2d& start, const Eigen::Vector2d& goal) {
  const Pixel from = OccupancyMap::pixel_of(map->to_pixel(start));
  const Pixel to = OccupancyMap::pixel_of(map->to_pixel(goal));
  if (!map->is_free(from) || !map->is_free(to)) return false;
  const auto known = std::find_if(floods.begin(), floods.end(), [&](const Flood& f) { return f.reached(from); });
  if (known != floods.end()) return known->reached(to);
  floods.emplace_back(map->free_mask(), map->width(), map->height(), from);
  return floods.back().reached(to);
}

std::shared_ptr<const OccupancyMap> Room::joining(const Eigen::Vector2d& start, const Eigen::Vector2d& goal) {
  std::size_t level = 0;
  for (int factor = coarsest_; factor >= 1; factor /= 2, ++level) {
    if (level == levels_.size()) {
      levels_.push_back({factor == 1 ? map_ : std::make_shared<const OccupancyMap>(map_->coarsened(factor)), {}});
    }
    if (levels_[level].joins(start, goal)) return levels_[level].map;
  }
  return nullptr;
}

const std::shared_ptr<const CollisionMap>& Room::collision() {
  if (!collision_) collision_ = std::make_shared<const CollisionMap>(map_);
  return collision_;
}

}  // namespace lrrt
