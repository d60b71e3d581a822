// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "lrrt/region/promising_region.hpp"
#include "lrrt/sampling/random.hpp"

namespace lrrt {

/// Draws points of a map. Knows no planner: a point is a position in pixel coordinates.
class SamplingStrategy {
 public:
  virtual ~SamplingStrategy() = default;
  /// One random point, pixel coordinates. Allocates nothing.
  virtual Eigen::Vector2d draw(Random& random) const = 0;
};

/// Every point of the map with the same density.
class UniformStrategy final : public SamplingStrategy {
 public:
  UniformStrategy(int width, int height) : width_(width), height_(height) {}
  Eigen::Vector2d draw(Random& random) const override;

 private:
  double width_;
  double height_;
};

/// Every point of the promising region with the same density (the paper's sampler): a random pixel of the mask, and a
/// random /// point inside it, since pixel centres would repeat and coincide with nodes of the tree.
///
/// Where the region had to be bridged, half of the points come from the middle lines of the bridges instead: they are
/// the only known way, often a passage of a few pixels that draws over the whole region would hardly ever hit.
class RegionStrategy final : public SamplingStrategy {
 public:
  /// @throws RequestError when the region holds no pixel: check PromisingRegion::area first.
  explicit RegionStrategy(const PromisingRegion& region);
  Eigen::Vector2d draw(Random& random) const override;

 private:
  std::vector<Pixel> pixels_;
  std::vector<Pixel> bridge_;
};

/// How many points were drawn from where.
struct DrawCounts {
  std::size_t guided = 0;
  std::size_t uniform = 0;
};

/// The paper's sampler: with probability α a guided point, otherwise a uniform one of the whole map.
///
/// For α < 1 every point of the map keeps a positive density, so a planner that is probabilistically complete stays
/// so. α = 1 is allowed, as in the paper, and gives that up: a path that leaves the region is then never found.
class MixedSampler {
 public:
  /// @param guided may be null, then every draw is uniform.
  /// @param alpha share of guided draws, in [0, 1]. @throws RequestError when it is not.
  MixedSampler(std::unique_ptr<SamplingStrategy> guided, UniformStrategy uniform, double alpha, std::uint64_t seed);

  /// The next point, pixel coordinates.
  Eigen::Vector2d draw();
  DrawCounts counts() const { return counts_; }

 private:
  std::unique_ptr<SamplingStrategy> guided_;
  UniformStrategy uniform_;
  double alpha_;
  Random random_;
  DrawCounts counts_{};
};

}  // namespace lrrt
