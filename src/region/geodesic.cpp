// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/region/geodesic.hpp"

#include <algorithm>
#include <array>

namespace lrrt {
namespace {

/// One more than the longest step: pixels that wait never lie farther apart.
constexpr std::size_t bucket_count = 8;

}  // namespace

Geodesic::Geodesic(const std::vector<std::uint8_t>& mask, int width, int height, Pixel source)
    : width_(width),
      height_(height),
      distance_((static_cast<std::size_t>(width) + 2) * (static_cast<std::size_t>(height) + 2), unreached) {
  for (int r = 0; r < height; ++r) {
    const auto* row = mask.data() + static_cast<std::size_t>(r) * static_cast<std::size_t>(width);
    std::transform(row, row + width, distance_.begin() + static_cast<std::ptrdiff_t>(place({0, r})),
                   [](std::uint8_t inside) { return inside != 0 ? waiting : unreached; });
  }
  const bool on_picture = source.c >= 0 && source.r >= 0 && source.c < width && source.r < height;
  if (on_picture && distance_[place(source)] == waiting) spread(source);
}

Pixel Geodesic::step_towards_source(Pixel from) const {
  const std::int32_t here = at(from);
  if (here == unreached) return from;
  for (int k = 0; k < 9; ++k) {
    const Pixel to{from.c + k % 3 - 1, from.r + k / 3 - 1};
    const std::int32_t cost = k % 2 == 0 ? diagonal : straight;
    if (k == 4 || at(to) == unreached || at(to) + cost != here) continue;
    const bool corner = k % 2 == 0 && (at({to.c, from.r}) == unreached || at({from.c, to.r}) == unreached);
    if (!corner) return to;
  }
  return from;
}

void Geodesic::spread(Pixel source) {
  std::array<std::vector<std::uint32_t>, bucket_count> buckets;
  std::size_t open = 0;
  const auto offer = [&](std::size_t to, std::int32_t distance) {
    if (distance >= distance_[to]) return;  // pixels outside the set have less than any
    distance_[to] = distance;
    buckets[static_cast<std::size_t>(distance) % bucket_count].push_back(static_cast<std::uint32_t>(to));
    ++open;
  };
  const auto row = static_cast<std::uint32_t>(width_) + 2;
  offer(place(source), 0);
  for (std::int32_t now = 0; open > 0; ++now) {
    std::vector<std::uint32_t>& bucket = buckets[static_cast<std::size_t>(now) % bucket_count];
    open -= bucket.size();
    for (const std::uint32_t p : bucket) {
      if (distance_[p] != now) continue;  // reached on a shorter way meanwhile
      reached_.push_back({static_cast<int>(p % row) - 1, static_cast<int>(p / row) - 1});
      const bool left = distance_[p - 1] != unreached;
      const bool right = distance_[p + 1] != unreached;
      const bool above = distance_[p - row] != unreached;
      const bool below = distance_[p + row] != unreached;
      if (right) offer(p + 1, now + straight);
      if (below) offer(p + row, now + straight);
      if (left) offer(p - 1, now + straight);
      if (above) offer(p - row, now + straight);
      if (right && below) offer(p + row + 1, now + diagonal);
      if (left && below) offer(p + row - 1, now + diagonal);
      if (left && above) offer(p - row - 1, now + diagonal);
      if (right && above) offer(p - row + 1, now + diagonal);
    }
    bucket.clear();
  }
}

}  // namespace lrrt
