// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <vector>

#include "lrrt/sampling/mixed_sampler.hpp"
#include "lrrt/sampling/strategy.hpp"
#include "lrrt/sampling/uniform.hpp"
#include "support.hpp"

namespace lrrt {
namespace {

using Shares = std::vector<double>;

constexpr int side = 24;
constexpr std::size_t draws = 200000;

OccupancyMap open_map() {
  return test::map_from_rows(std::vector<std::string>(side, std::string(side, '.')));
}

/// Draws points and holds how many fell into which pixel against the shares that are claimed (Pearson's chi-squared;
/// Wilson and Hilferty's approximation of its distribution). A true claim fails for one seed in a million, and the
/// seeds are fixed.
void expect_shares(const Shares& claimed, const std::function<Eigen::Vector2d()>& draw) {
  ASSERT_NEAR(std::accumulate(claimed.begin(), claimed.end(), 0.0), 1.0, 1e-9);
  std::vector<double> hits(claimed.size(), 0.0);
  for (std::size_t i = 0; i < draws; ++i) {
    const Pixel pixel = OccupancyMap::pixel_of(draw());
    ASSERT_TRUE(pixel.c >= 0 && pixel.r >= 0 && pixel.c < side && pixel.r < side);
    hits[static_cast<std::size_t>(pixel.r * side + pixel.c)] += 1.0;
  }
  double squares = 0.0;
  double bins = 0.0;
  for (std::size_t i = 0; i < claimed.size(); ++i) {
    const double expected = claimed[i] * static_cast<double>(draws);
    if (claimed[i] == 0.0) {
      ASSERT_EQ(hits[i], 0.0) << "pixel " << i << " is never drawn";
    }
    if (expected < 5.0) continue;  // too few for the approximation
    squares += (hits[i] - expected) * (hits[i] - expected) / expected;
    bins += 1.0;
  }
  const double spread = 2.0 / (9.0 * (bins - 1.0));
  const double deviations = (std::cbrt(squares / (bins - 1.0)) - (1.0 - spread)) / std::sqrt(spread);
  EXPECT_LT(deviations, 4.75) << squares << " over " << bins << " pixels";
}

/// A region of two thirds of the map, with two columns missing in the middle and a hole.
PromisingRegion broken_region(const OccupancyMap& map) {
  std::vector<float> probability(map.size(), 1.0F);
  for (int r = 0; r < side; ++r) {
    for (int c = 0; c < side; ++c) {
      const bool gap = c == 11 || c == 12;
      if (gap || r >= 16 || (r > 3 && r < 6 && c < 5)) probability[map.index({c, r})] = 0.0F;
    }
  }
  return {map, probability, {0, 0}, {side - 1, 0}};
}

Shares shares_of(const PromisingRegion& region) {
  Shares shares;
  for (const std::uint8_t in : region.mask()) shares.push_back(in / static_cast<double>(region.area()));
  return shares;
}

/// The share of an area in each pixel, by 40 × 40 points in each.
Shares shares_where(const std::function<bool(const Eigen::Vector2d&)>& inside) {
  Shares shares(side * side, 0.0);
  for (int i = 0; i < side * side; ++i) {
    for (int k = 0; k < 1600; ++k) {
      const Eigen::Vector2d point(i % side + (k % 40 + 0.5) / 40.0, i / side + (k / 40 + 0.5) / 40.0);
      shares[static_cast<std::size_t>(i)] += static_cast<double>(inside(point));
    }
  }
  const double all = std::accumulate(shares.begin(), shares.end(), 0.0);
  // a pixel that the grid of points just misses may be drawn once in a while
  for (double& share : shares) share = std::max(share / all, 1e-12);
  return shares;
}

TEST(Draws, OfARegionAreEvenOverItsMask) {
  const PromisingRegion region = broken_region(open_map());
  RegionStrategy strategy(region);
  Random random(81);
  expect_shares(shares_of(region), [&] { return strategy.draw(random); });
}

TEST(Draws, OfABridgedRegionComeHalfFromTheBridge) {
  const OccupancyMap map = open_map();
  const PromisingRegion region = broken_region(map).bridged(map, {0, 0}, {side - 1, 0}, 2);
  ASSERT_FALSE(region.bridge().empty());
  Shares claimed = shares_of(region);
  for (double& share : claimed) share *= 0.5;
  for (const Pixel p : region.bridge()) claimed[map.index(p)] += 0.5 / static_cast<double>(region.bridge().size());
  RegionStrategy strategy(region);
  Random random(82);
  expect_shares(claimed, [&] { return strategy.draw(random); });
}

TEST(Draws, OfTheWholeMapAreEven) {
  const UniformStrategy strategy(side, side);
  Random random(83);
  expect_shares(Shares(side * side, 1.0 / (side * side)), [&] { return strategy.draw(random); });
}

TEST(Draws, NearAPointAreEvenInTheBoxAroundIt) {
  const UniformStrategy strategy(side, side);
  const auto inside = [](const Eigen::Vector2d& p) { return p.x() > 3.5 && p.x() < 13.5 && p.y() < 7.25; };
  Random random(84);
  expect_shares(shares_where(inside), [&] { return strategy.draw_near({8.5, 2.25}, 5.0, random); });
}

TEST(Draws, OnceInformedAreEvenOverTheEllipse) {
  const Eigen::Vector2d start(4.0, 5.0);
  const Eigen::Vector2d goal(18.0, 11.0);
  for (const double length : {16.0, 20.0, 30.0, 60.0}) {  // inside the map, partly beside it, larger than it
    UniformStrategy strategy(side, side);
    strategy.inform(start, goal, length);
    const auto inside = [&](const Eigen::Vector2d& p) { return (p - start).norm() + (p - goal).norm() < length; };
    Random random(85);
    expect_shares(shares_where(inside), [&] { return strategy.draw(random); });
  }
}

TEST(Draws, OfTheMixtureKeepItsShares) {
  const PromisingRegion region = broken_region(open_map());
  for (const double alpha : {0.0, 0.25, 0.8, 1.0}) {
    Shares claimed = shares_of(region);
    for (double& share : claimed) share = alpha * share + (1.0 - alpha) / (side * side);
    MixedSampler sampler(std::make_unique<RegionStrategy>(region), UniformStrategy(side, side), alpha, 86);
    expect_shares(claimed, [&] { return sampler.draw(); });
  }
}

}  // namespace
}  // namespace lrrt
