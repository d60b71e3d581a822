// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "lrrt/sampling/strategy.hpp"
#include "lrrt/sampling/uniform.hpp"

namespace lrrt {

/// How many points were drawn from where.
struct DrawCounts {
  std::size_t guided = 0;   ///< from the strategy
  std::size_t uniform = 0;  ///< from the whole map
};

/// The paper's sampler: with probability α a guided point, otherwise a uniform one of the whole map.
///
/// For α < 1 every point of the map keeps a positive density until a path is known, and every point that could shorten
/// it afterwards, so a planner that is complete and optimal in the limit stays so. α = 1 is allowed, as in the paper,
/// and gives that up: a path that leaves the region may then never be found.
class MixedSampler {
 public:
  /// @param guided may be null, then every draw is uniform.
  /// @param alpha share of guided draws, in [0, 1]; a strategy that lacks confidence takes less.
  /// @throws RequestError when alpha is out of range.
  MixedSampler(std::unique_ptr<SamplingStrategy> guided, const UniformStrategy& uniform, double alpha,
               std::uint64_t seed);

  /// The next point, pixel coordinates.
  Eigen::Vector2d draw();
  /// True when the next draw shall be a guided one. Used where the draw itself is not the sampler's to make.
  bool wants_guided() { return guided_ && random_.uniform() < alpha_ * guided_->confidence(); }
  /// One guided point, not counted. There must be a guided strategy.
  Eigen::Vector2d draw_guided() { return guided_->draw(random_); }
  /// One uniform point, not counted.
  Eigen::Vector2d draw_uniform() { return uniform_.draw(random_); }
  /// One number in [0, 1), for coordinates that a point of the map does not have.
  double draw_number() { return random_.uniform(); }
  /// Which way leads on to the goal from a point, see SamplingStrategy::direction.
  std::optional<Eigen::Vector2d> direction(const Eigen::Vector2d& point) const {
    return guided_ ? guided_->direction(point) : std::nullopt;
  }
  /// One uniform point over which a path between two points, pixel coordinates, could be shorter than `length`; not
  /// counted.
  Eigen::Vector2d draw_informed(const Eigen::Vector2d& start, const Eigen::Vector2d& goal, double length);
  /// One uniform point at most `reach` pixels away along either axis; not counted.
  Eigen::Vector2d draw_near(const Eigen::Vector2d& centre, double reach) {
    return uniform_.draw_near(centre, reach, random_);
  }
  /// Counts a draw that another sampler made, guided or not.
  void count(bool guided) { ++(guided ? counts_.guided : counts_.uniform); }
  /// True for a point that the guided strategy could draw.
  bool promising(const Eigen::Vector2d& point) const { return guided_ && guided_->contains(point); }
  /// Passes a free motion on to the guided strategy, see SamplingStrategy::connected.
  void connected(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    if (guided_) guided_->connected(from, to);
  }
  /// Passes a better path on to the guided strategy, see SamplingStrategy::improved.
  void improved(const std::vector<Eigen::Vector2d>& path, double length);
  /// Draws so far, those that others made and counted here included.
  DrawCounts counts() const { return counts_; }

 private:
  std::unique_ptr<SamplingStrategy> guided_;
  UniformStrategy uniform_;
  double alpha_;
  Random random_;
  DrawCounts counts_{};
};

}  // namespace lrrt
