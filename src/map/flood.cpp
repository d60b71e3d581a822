// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/map/flood.hpp"

#include <algorithm>

namespace lrrt {

Flood::Flood(const std::vector<std::uint8_t>& mask, int width, int height, Pixel from)
    : width_(width), height_(height), reached_(mask.size(), 0) {
  const auto row_of = [&](int r) { return static_cast<std::size_t>(r) * static_cast<std::size_t>(width); };
  const auto waits = [&](std::size_t row, int c) {
    const std::size_t i = row + static_cast<std::size_t>(c);
    return mask[i] != 0 && reached_[i] == 0;
  };
  const bool inside = from.c >= 0 && from.r >= 0 && from.c < width && from.r < height;
  if (!inside || !waits(row_of(from.r), from.c)) return;
  Pixel low = from;
  Pixel high = from;
  std::vector<Pixel> open{from};
  while (!open.empty()) {
    const Pixel seed = open.back();
    open.pop_back();
    const std::size_t row = row_of(seed.r);
    if (!waits(row, seed.c)) continue;
    // the whole run of the row at once, then one seed for each run that touches it from above and from below
    int first = seed.c;
    int last = seed.c;
    while (first > 0 && waits(row, first - 1)) --first;
    while (last + 1 < width && waits(row, last + 1)) ++last;
    std::fill(reached_.begin() + static_cast<std::ptrdiff_t>(row) + first,
              reached_.begin() + static_cast<std::ptrdiff_t>(row) + last + 1, std::uint8_t{1});
    low = {std::min(low.c, first), std::min(low.r, seed.r)};
    high = {std::max(high.c, last), std::max(high.r, seed.r)};
    for (const int r : {seed.r - 1, seed.r + 1}) {
      if (r < 0 || r >= height) continue;
      for (int c = first; c <= last; ++c) {
        if (waits(row_of(r), c) && (c == first || !waits(row_of(r), c - 1))) open.push_back({c, r});
      }
    }
  }
  box_ = {low.c, low.r, high.c - low.c + 1, high.r - low.r + 1};
}

}  // namespace lrrt
