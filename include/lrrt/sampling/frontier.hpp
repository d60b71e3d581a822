// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "lrrt/region/geodesic.hpp"
#include "lrrt/region/promising_region.hpp"
#include "lrrt/sampling/short_ways.hpp"
#include "lrrt/sampling/strategy.hpp"

namespace lrrt {

/// How a planner uses its samples.
enum class Growth {
  one_tree,   ///< a tree from the start, sample by sample (RRT, RRT*)
  two_trees,  ///< a second one from the goal (RRT-Connect)
  batch,      ///< many samples before any motion is checked (PRM, BIT*, FMT*): there is no tree to run ahead of
};

/// What a frontier has to know of the planner.
struct FrontierOptions {
  double step = 6.0;  ///< longest extension of a tree, pixels: the band reaches two of them ahead, one back
  Growth growth = Growth::one_tree;  ///< how the planner uses its samples
};

/// Points just ahead of the tree.
///
/// The pixels of a connected region are put in order by their walking distance to the goal inside it. The *horizon* is
/// how near to the goal the tree has come along that order; points are drawn from a band around it, where an extension
/// is likely to succeed and to lead on. Most draws over the whole region lie far ahead of the tree, behind walls.
///
/// Motions that turn out free carry the horizon on. Only pixels whose detour over them is short take part, so dead ends
/// that the region holds are left out. When no motion carries the horizon on, the band widens until it is the whole
/// region, and the wish for guided draws (`confidence`) fades, so that a wrong region costs little; progress restores
/// both. Draws take constant time and allocate nothing, but for the one that makes ShortWays.
///
/// Once a path is known, the region has done its job. Half of the draws fall around the path's corners, where small
/// moves shorten it most (Akgun and Stilman 2011), fewer as the path stops getting shorter; the others wherever a
/// shorter path could lead (ShortWays), so that a region that led along the wrong side of an obstacle costs little. At
/// first, and on maps of more than half a million pixels for good, they fall on the region instead.
class FrontierStrategy final : public SamplingStrategy {
 public:
  /// @param map in which the region lies, to look for shorter ways outside it. @param region must be connected: see
  /// PromisingRegion::bridged.
  /// @param start,goal pixels of the region.
  /// @throws RequestError when the region does not join start and goal, or the step is not positive.
  FrontierStrategy(std::shared_ptr<const OccupancyMap> map, const PromisingRegion& region, Pixel start, Pixel goal,
                   const FrontierOptions& options);

  Eigen::Vector2d draw(Random& random) override;
  bool contains(const Eigen::Vector2d& point) const override;
  /// Along the shortest way to the goal inside the region, four to twelve pixels ahead: about a step of the planner.
  std::optional<Eigen::Vector2d> direction(const Eigen::Vector2d& point) const override;
  double confidence() const override;
  void connected(const Eigen::Vector2d& from, const Eigen::Vector2d& to) override;
  bool improved(const std::vector<Eigen::Vector2d>& path, double length) override;

  /// Walking distance inside the region that a tree still has to go, pixels. @param tree 0 from start, 1 from goal.
  double remaining(std::size_t tree) const { return fronts_[tree].horizon * Geodesic::unit; }

 private:
  /// One tree's order of the region's pixels and how far it has come.
  struct Front {
    Geodesic to_other;               ///< walking distance to the other tree's root
    std::vector<Pixel> pixels;       ///< those that take part, nearest to the other root first
    std::vector<std::size_t> first;  ///< first[d]: index of the first pixel with a distance of at least d pixels
    std::vector<Pixel> way;          ///< those of the shortest ways from root to root, in the same order
    std::int32_t horizon = 0;
  };

  /// A front without its distances.
  static Front make_front(const Geodesic& to_other, const Geodesic& from_own, Pixel root, std::int32_t most_detour);
  Eigen::Vector2d draw_ahead(Random& random);
  /// A pixel of the shortest ways, as near to the horizon as one step.
  Pixel draw_on_way(const Front& front, Random& random) const;
  Eigen::Vector2d draw_for_shorter(Random& random);
  Eigen::Vector2d draw_at_corner(Random& random) const;
  Eigen::Vector2d draw_on_region(Random& random) const;
  /// Share that halves with so many draws that brought nothing.
  double fading(double half_life) const;
  bool inside(Pixel p) const { return p.c >= 0 && p.r >= 0 && p.c < width_ && p.r < height_; }
  std::size_t index(Pixel p) const {
    return static_cast<std::size_t>(p.r) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(p.c);
  }

  std::shared_ptr<const OccupancyMap> map_;
  int width_;
  int height_;
  Pixel start_;
  Pixel goal_;
  double step_;
  Growth growth_;
  std::size_t trees_;
  std::array<Front, 2> fronts_;
  std::vector<std::uint8_t> tree_of_;  ///< per pixel of the map: bit 0 reached from start, bit 1 from goal
  std::uint32_t stalled_ = 0;          ///< draws since a horizon moved or a path became shorter
  std::size_t turn_ = 0;               ///< the tree that the next draw is for
  std::vector<Eigen::Vector2d> path_;  ///< the best path so far; empty before the first
  double length_ = 0.0;                ///< of that path, pixels; infinite where cost is no length
  double noted_length_ = 0.0;          ///< of the path that last was shorter by enough to count
  std::size_t draws_on_path_ = 0;      ///< since the first path
  std::optional<ShortWays> ways_;      ///< made when enough draws were asked for to pay for it
};

}  // namespace lrrt
