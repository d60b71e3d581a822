// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/region/geodesic.hpp"

#include <array>

namespace lrrt {
namespace {

struct Step {
  int dc;
  int dr;
  std::int32_t length;
};

constexpr std::array<Step, 8> steps = {
    {{1, 0, 5}, {0, 1, 5}, {-1, 0, 5}, {0, -1, 5}, {1, 1, 7}, {-1, 1, 7}, {-1, -1, 7}, {1, -1, 7}}};
/// One more than the longest step: pixels that wait never lie farther apart.
constexpr std::size_t bucket_count = 8;

}  // namespace

Geodesic::Geodesic(const std::vector<std::uint8_t>& mask, int width, int height, Pixel source)
    : width_(width), height_(height), distance_(mask.size(), unreached) {
  const auto index = [&](int c, int r) {
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(width) + static_cast<std::size_t>(c);
  };
  const auto inside = [&](int c, int r) {
    return c >= 0 && r >= 0 && c < width && r < height && mask[index(c, r)] != 0;
  };
  if (!inside(source.c, source.r)) return;
  std::array<std::vector<Pixel>, bucket_count> buckets;
  buckets[0].push_back(source);
  distance_[index(source.c, source.r)] = 0;
  std::size_t waiting = 1;
  for (std::int32_t now = 0; waiting > 0; ++now) {
    std::vector<Pixel>& bucket = buckets[static_cast<std::size_t>(now) % bucket_count];
    for (const Pixel p : bucket) {
      --waiting;
      if (distance_[index(p.c, p.r)] != now) continue;  // reached on a shorter way meanwhile
      reached_.push_back(p);
      for (const Step& step : steps) {
        const int c = p.c + step.dc;
        const int r = p.r + step.dr;
        if (!inside(c, r)) continue;
        if (step.dc != 0 && step.dr != 0 && !(inside(c, p.r) && inside(p.c, r))) continue;
        std::int32_t& known = distance_[index(c, r)];
        const std::int32_t next = now + step.length;
        if (known != unreached && known <= next) continue;
        known = next;
        buckets[static_cast<std::size_t>(next) % bucket_count].push_back({c, r});
        ++waiting;
      }
    }
    bucket.clear();
  }
}

}  // namespace lrrt
