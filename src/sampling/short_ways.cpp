// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/sampling/short_ways.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lrrt/sampling/strategy.hpp"

namespace lrrt {
namespace {

/// Ways counted in steps to eight neighbours are longer than straight ones by up to this factor, but for staircases of
/// single pixels, and by a few pixels for the ends inside their pixels.
constexpr double longest_detour = 1.09;
constexpr double slack = 4.0;

/// Counted steps that a way over a pixel may have when it could be shorter than a length in pixels.
std::int32_t most_steps(double length) {
  const double steps = (longest_detour * length + slack) / Geodesic::unit;
  return static_cast<std::int32_t>(std::min(steps, 0.5 * std::numeric_limits<std::int32_t>::max()));
}

}  // namespace

std::optional<ShortWays> ShortWays::between(const OccupancyMap& map, Pixel start, Pixel goal, double length) {
  const std::vector<std::uint8_t> free = map.free_mask();
  const Geodesic from_start(free, map.width(), map.height(), start);
  const std::int32_t shortest = from_start.at(goal);
  if (shortest == Geodesic::unreached) return std::nullopt;
  return ShortWays(from_start, Geodesic(free, map.width(), map.height(), goal), shortest, length);
}

ShortWays::ShortWays(const Geodesic& from_start, const Geodesic& from_goal, std::int32_t shortest, double length)
    : shortest_(shortest) {
  const std::int32_t most = std::max(most_steps(length), shortest_);
  const auto excess = [&](Pixel p) {
    const std::int32_t steps = from_start.at(p) + from_goal.at(p);
    return steps <= most ? static_cast<std::size_t>(steps - shortest_) : std::numeric_limits<std::size_t>::max();
  };
  // Sorted by counting: what every excess has, where each begins, then everybody to his place.
  for (const Pixel p : from_start.reached()) {
    const std::size_t n = excess(p);
    if (n == std::numeric_limits<std::size_t>::max()) continue;
    if (first_.size() < n + 2) first_.resize(n + 2, 0);
    ++first_[n + 1];
  }
  for (std::size_t n = 1; n < first_.size(); ++n) first_[n] += first_[n - 1];
  pixels_.resize(first_.back());
  std::vector<std::size_t> next = first_;
  for (const Pixel p : from_start.reached()) {
    const std::size_t n = excess(p);
    if (n != std::numeric_limits<std::size_t>::max()) pixels_[next[n]++] = p;
  }
  count_ = pixels_.size();
}

void ShortWays::limit(double length) {
  const std::int32_t most = std::max(most_steps(length), shortest_);
  count_ = first_[std::min(static_cast<std::size_t>(most - shortest_) + 1, first_.size() - 1)];
}

Eigen::Vector2d ShortWays::draw(Random& random) const {
  return point_in(pixels_[random.index(count_)], random);
}

}  // namespace lrrt
