// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/sampling/strategy.hpp"

#include "lrrt/error.hpp"

namespace lrrt {

RegionStrategy::RegionStrategy(const PromisingRegion& region)
    : width_(region.width()), height_(region.height()), mask_(region.mask()), bridge_(region.bridge()) {
  if (region.area() == 0) {
    throw RequestError(
        "the promising region is empty: there is nothing to draw from; use the uniform strategy instead");
  }
  pixels_.reserve(region.area());
  for (std::size_t i = 0; i < mask_.size(); ++i) {
    const auto width = static_cast<std::size_t>(width_);
    if (mask_[i] != 0) pixels_.push_back({static_cast<int>(i % width), static_cast<int>(i / width)});
  }
}

Eigen::Vector2d RegionStrategy::draw(Random& random) {
  const bool from_bridge = !bridge_.empty() && random.uniform() < 0.5;
  const std::vector<Pixel>& pixels = from_bridge ? bridge_ : pixels_;
  return point_in(pixels[random.index(pixels.size())], random);
}

bool RegionStrategy::contains(const Eigen::Vector2d& point) const {
  const Pixel p = OccupancyMap::pixel_of(point);
  if (p.c < 0 || p.r < 0 || p.c >= width_ || p.r >= height_) return false;
  return mask_[static_cast<std::size_t>(p.r) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(p.c)] != 0;
}

}  // namespace lrrt
