// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <string>

#include "gap.hpp"
#include "lrrt/error.hpp"
#include "lrrt/region/promising_region.hpp"

namespace lrrt {
namespace {

/// Probabilities are told apart in so many steps: one bucket of waiting pixels for each.
constexpr int steps = 256;
constexpr std::uint8_t unvisited = 4;

/// The way whose least probability is the highest ("widest path"), from goal back to start, over free pixels of at
/// least the lowest probability; empty when there is none. Start and goal may have any probability.
std::vector<Pixel> most_probable_way(const OccupancyMap& map, const std::vector<float>& probability, Pixel start,
                                     Pixel goal, float lowest) {
  std::array<std::vector<Pixel>, steps> open;
  std::vector<std::uint8_t> arrived_by(map.size(), unvisited);
  const auto bucket_of = [&](std::size_t i) {
    return std::clamp(static_cast<int>(probability[i] * static_cast<float>(steps)), 0, steps - 1);
  };
  open[steps - 1].push_back(start);
  arrived_by[map.index(start)] = 0;
  for (int level = steps - 1; level >= 0; --level) {
    std::vector<Pixel>& bucket = open[static_cast<std::size_t>(level)];
    std::size_t head = 0;
    while (head < bucket.size()) {  // first in, first out: short among equally probable ways; the bucket may grow
      const Pixel p = bucket[head++];
      for (std::size_t side = 0; side < sides.size(); ++side) {
        const Pixel next{p.c + sides[side].c, p.r + sides[side].r};
        if (!map.is_free(next)) continue;
        const std::size_t i = map.index(next);
        if (arrived_by[i] != unvisited) continue;
        if (next != goal && !(probability[i] >= lowest)) continue;  // NaN is not
        arrived_by[i] = static_cast<std::uint8_t>(side);
        if (next == goal) return way_back(map, arrived_by, start, goal);
        open[static_cast<std::size_t>(std::min(level, bucket_of(i)))].push_back(next);
      }
    }
  }
  return {};
}

}  // namespace

PromisingRegion PromisingRegion::linked(const OccupancyMap& map, Pixel start, Pixel goal, float lowest,
                                        int halo) const {
  check_belongs_to(map);
  if (!(lowest >= 0.0F && lowest <= 1.0F) || halo < 0) {
    throw RequestError("lowest probability " + std::to_string(lowest) + " and halo " + std::to_string(halo) +
                       ": expected a probability from 0 to 1 and zero or more pixels");
  }
  if (connected_ || start == goal || !map.is_free(start) || !map.is_free(goal)) return *this;
  const std::vector<Pixel> way = most_probable_way(map, probability_, start, goal, lowest);
  PromisingRegion result = *this;
  result.link_area_ += close_gap(map, gap_of(map, way, mask_), halo, result.mask_, [&](Pixel of_way, Pixel p) {
    return p == of_way || probability_[map.index(p)] >= lowest;
  });
  result.area_ += result.link_area_;
  result.connected_ = !way.empty();
  return result;
}

}  // namespace lrrt
