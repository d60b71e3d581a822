// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <deque>
#include <limits>
#include <string>

#include "lrrt/error.hpp"
#include "lrrt/region/promising_region.hpp"

namespace lrrt {
namespace {

constexpr std::array<Pixel, 4> sides = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
constexpr std::int32_t unreached = std::numeric_limits<std::int32_t>::max();

/// Search over free pixels where a step inside the mask costs 0 and any other costs 1, with a double-ended queue
/// instead of a heap. @return the way from goal back to start; empty when there is none.
std::vector<Pixel> cheapest_detour(const OccupancyMap& map, const std::vector<std::uint8_t>& mask, Pixel start,
                                   Pixel goal) {
  std::vector<std::int32_t> cost(map.size(), unreached);
  std::vector<std::uint8_t> arrived_by(map.size(), 0);
  std::deque<Pixel> open{start};
  cost[map.index(start)] = 0;
  while (!open.empty()) {
    const Pixel p = open.front();
    open.pop_front();
    if (p == goal) break;
    for (std::size_t side = 0; side < sides.size(); ++side) {
      const Pixel next{p.c + sides[side].c, p.r + sides[side].r};
      if (!map.is_free(next)) continue;
      const std::size_t i = map.index(next);
      const std::int32_t step = mask[i] != 0 ? 0 : 1;
      if (cost[map.index(p)] + step >= cost[i]) continue;
      cost[i] = cost[map.index(p)] + step;
      arrived_by[i] = static_cast<std::uint8_t>(side);
      step == 0 ? open.push_front(next) : open.push_back(next);
    }
  }
  if (cost[map.index(goal)] == unreached) return {};
  std::vector<Pixel> way{goal};
  while (way.back() != start) {
    const Pixel side = sides[arrived_by[map.index(way.back())]];
    way.push_back({way.back().c - side.c, way.back().r - side.r});
  }
  return way;
}

}  // namespace

PromisingRegion PromisingRegion::bridged(const OccupancyMap& map, Pixel start, Pixel goal, int halo) const {
  if (map.width() != width_ || map.height() != height_) {
    throw RequestError("a region of " + std::to_string(width_) + "×" + std::to_string(height_) +
                       " pixels cannot be bridged on a map of " + std::to_string(map.width()) + "×" +
                       std::to_string(map.height()) + ": give the map it was predicted for");
  }
  if (halo < 0) throw RequestError("halo of " + std::to_string(halo) + " pixels: expected zero or more");
  if (connected_ || !map.is_free(start) || !map.is_free(goal)) return *this;
  halo = std::min(halo, std::max(width_, height_));
  const std::vector<Pixel> way = cheapest_detour(map, mask_, start, goal);
  PromisingRegion result = *this;
  for (const Pixel p : way) {
    if (mask_[map.index(p)] != 0) continue;
    result.bridge_.push_back(p);
    for (int r = std::max(0, p.r - halo); r <= std::min(height_ - 1, p.r + halo); ++r) {
      for (int c = std::max(0, p.c - halo); c <= std::min(width_ - 1, p.c + halo); ++c) {
        std::uint8_t& pixel = result.mask_[map.index({c, r})];
        if (pixel != 0 || !map.is_free({c, r})) continue;
        pixel = 1;
        ++result.bridge_area_;
      }
    }
  }
  result.area_ += result.bridge_area_;
  result.connected_ = !way.empty();
  return result;
}

}  // namespace lrrt
