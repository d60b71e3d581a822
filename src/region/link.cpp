// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "lrrt/error.hpp"
#include "lrrt/region/promising_region.hpp"

namespace lrrt {
namespace {

constexpr std::array<Pixel, 4> sides = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
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
        if (next == goal) {
          std::vector<Pixel> way{goal};
          while (way.back() != start) {
            const Pixel back = sides[arrived_by[map.index(way.back())]];
            way.push_back({way.back().c - back.c, way.back().r - back.r});
          }
          return way;
        }
        open[static_cast<std::size_t>(std::min(level, bucket_of(i)))].push_back(next);
      }
    }
  }
  return {};
}

}  // namespace

PromisingRegion PromisingRegion::linked(const OccupancyMap& map, Pixel start, Pixel goal, float lowest,
                                        int halo) const {
  if (map.width() != width_ || map.height() != height_) {
    throw RequestError("a region of " + std::to_string(width_) + "×" + std::to_string(height_) +
                       " pixels cannot be linked on a map of " + std::to_string(map.width()) + "×" +
                       std::to_string(map.height()) + ": give the map it was predicted for");
  }
  if (!(lowest >= 0.0F && lowest <= 1.0F) || halo < 0) {
    throw RequestError("lowest probability " + std::to_string(lowest) + " and halo " + std::to_string(halo) +
                       ": expected a probability from 0 to 1 and zero or more pixels");
  }
  if (connected_ || start == goal || !map.is_free(start) || !map.is_free(goal)) return *this;
  halo = std::min(halo, std::max(width_, height_));
  const std::vector<Pixel> way = most_probable_way(map, probability_, start, goal, lowest);
  PromisingRegion result = *this;
  for (const Pixel p : way) {
    if (mask_[map.index(p)] != 0) continue;
    for (int r = std::max(0, p.r - halo); r <= std::min(height_ - 1, p.r + halo); ++r) {
      for (int c = std::max(0, p.c - halo); c <= std::min(width_ - 1, p.c + halo); ++c) {
        const std::size_t i = map.index({c, r});
        const bool joins =
            result.mask_[i] == 0 && map.is_free({c, r}) && (Pixel{c, r} == p || probability_[i] >= lowest);
        result.mask_[i] = joins ? 1 : result.mask_[i];
        result.link_area_ += static_cast<std::size_t>(joins);
      }
    }
  }
  result.area_ += result.link_area_;
  result.connected_ = !way.empty();
  return result;
}

}  // namespace lrrt
