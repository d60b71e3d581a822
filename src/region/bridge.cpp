// SPDX-License-Identifier: BSD-3-Clause
#include <deque>
#include <limits>
#include <string>

#include "gap.hpp"
#include "lrrt/error.hpp"
#include "lrrt/region/promising_region.hpp"

namespace lrrt {
namespace {

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
  return way_back(map, arrived_by, start, goal);
}

}  // namespace

PromisingRegion PromisingRegion::bridged(const OccupancyMap& map, Pixel start, Pixel goal, int halo) const {
  check_belongs_to(map);
  if (halo < 0) throw RequestError("halo of " + std::to_string(halo) + " pixels: expected zero or more");
  if (connected_ || !map.is_free(start) || !map.is_free(goal)) return *this;
  const std::vector<Pixel> way = cheapest_detour(map, mask_, start, goal);
  PromisingRegion result = *this;
  const std::vector<Pixel> gap = gap_of(map, way, mask_);
  const std::size_t joined = close_gap(map, gap, halo, result.mask_, [](Pixel, Pixel) { return true; });
  result.bridge_.insert(result.bridge_.end(), gap.begin(), gap.end());
  result.bridge_area_ += joined;
  result.area_ += result.bridge_area_;
  result.connected_ = !way.empty();
  return result;
}

}  // namespace lrrt
