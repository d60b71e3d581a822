// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lrrt/region/promising_region.hpp"
#include "lrrt/sampling/random.hpp"

namespace lrrt {

/// A random point inside a pixel, pixel coordinates: pixel centres would repeat and coincide with nodes of a tree.
inline Eigen::Vector2d point_in(Pixel pixel, Random& random) {
  const double x = pixel.c + random.uniform();
  return {x, pixel.r + random.uniform()};
}

/// Draws points of a map. Knows no planner: a point is a position in pixel coordinates.
class SamplingStrategy {
 public:
  virtual ~SamplingStrategy() = default;
  /// One random point, pixel coordinates. Allocates nothing.
  virtual Eigen::Vector2d draw(Random& random) = 0;
  /// True for a point, pixel coordinates, that the strategy could draw before a path is known: samples near a state are
  /// chosen by this.
  virtual bool contains(const Eigen::Vector2d& point) const = 0;
  /// Which way leads on to the goal from a point, pixel coordinates, of any length but 0; nothing where the strategy
  /// does not know. Allocates nothing.
  virtual std::optional<Eigen::Vector2d> direction(const Eigen::Vector2d& /*point*/) const { return std::nullopt; }
  /// How much of its share of the draws the strategy wants for itself, in [0, 1].
  virtual double confidence() const { return 1.0; }
  /// Told of every motion that was found free, pixel coordinates; a strategy may follow the tree by them.
  virtual void connected(const Eigen::Vector2d& /*from*/, const Eigen::Vector2d& /*to*/) {}
  /// Told of every better path: its states in pixel coordinates from start to goal, and its length in pixels, infinite
  /// where cost is no length.
  /// @return true when the strategy wants uniform draws from now on only where they can shorten that path.
  virtual bool improved(const std::vector<Eigen::Vector2d>& /*path*/, double /*length*/) { return false; }
};

/// Every point of the promising region with the same density (the paper's sampler): a random pixel of the mask, and a
/// random point inside it, since pixel centres would repeat and coincide with nodes of the tree.
///
/// Where the region had to be bridged, half of the points come from the middle lines of the bridges instead: they are
/// the only known way, often a passage of a few pixels that draws over the whole region would hardly ever hit.
class RegionStrategy final : public SamplingStrategy {
 public:
  /// @throws RequestError when the region holds no pixel: check PromisingRegion::area first.
  explicit RegionStrategy(const PromisingRegion& region);
  Eigen::Vector2d draw(Random& random) override;
  bool contains(const Eigen::Vector2d& point) const override;

 private:
  int width_;
  int height_;
  std::vector<std::uint8_t> mask_;
  std::vector<Pixel> pixels_;
  std::vector<Pixel> bridge_;
};

}  // namespace lrrt
