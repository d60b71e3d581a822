// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/StateSampler.h>
#include <ompl/base/ValidStateSampler.h>

#include <memory>

#include "lrrt/ompl/map_projection.hpp"
#include "lrrt/ompl/map_validity.hpp"
#include "lrrt/sampling/strategy.hpp"

namespace lrrt {

/// Where guided states come from: points of the map drawn by a MixedSampler, brought to map units. One source may feed
/// several samplers of the same planner, so that its counts cover them all. Not for concurrent use.
class GuidedSource {
 public:
  GuidedSource(std::shared_ptr<const CollisionMap> map, MixedSampler sampler,
               std::shared_ptr<const MapProjection> projection)
      : map_(std::move(map)), sampler_(std::move(sampler)), projection_(std::move(projection)) {}

  /// Moves a state to the next point; its coordinates outside the map's plane stay as they are.
  void place(ompl::base::State* state) { projection_->write(map_->map().to_world(sampler_.draw()), state); }
  DrawCounts counts() const { return sampler_.counts(); }

 private:
  std::shared_ptr<const CollisionMap> map_;
  MixedSampler sampler_;
  std::shared_ptr<const MapProjection> projection_;
};

/// The paper's biased sampler as OMPL's ValidStateSampler: only collision-free states. For planners such as PRM.
class GuidedValidStateSampler final : public ompl::base::ValidStateSampler {
 public:
  GuidedValidStateSampler(const ompl::base::SpaceInformation* si, std::shared_ptr<GuidedSource> source);
  /// False when no free state was found within OMPL's number of attempts.
  bool sample(ompl::base::State* state) override;
  /// Not guided: a uniform free state near another one.
  bool sampleNear(ompl::base::State* state, const ompl::base::State* near, double distance) override;

 private:
  std::shared_ptr<GuidedSource> source_;
  ompl::base::StateSamplerPtr uniform_;
};

/// The same source as OMPL's StateSampler, whose states may be in collision. For planners such as RRT and RRT*.
class GuidedStateSampler final : public ompl::base::StateSampler {
 public:
  GuidedStateSampler(const ompl::base::StateSpace* space, std::shared_ptr<GuidedSource> source);
  void sampleUniform(ompl::base::State* state) override;
  void sampleUniformNear(ompl::base::State* state, const ompl::base::State* near, double distance) override;
  void sampleGaussian(ompl::base::State* state, const ompl::base::State* mean, double deviation) override;

 private:
  std::shared_ptr<GuidedSource> source_;
  ompl::base::StateSamplerPtr uniform_;
};

/// Sets both sampler allocators of a space information. It guides planners that call StateSampler::sampleUniform (RRT,
/// RRT*, RRT-Connect, …) or ValidStateSampler::sample (PRM, …); not the informed ones (Informed RRT*, BIT*, …), which
/// ask the objective for their sampler, nor those that only sample near a state (EST, KPIECE).
void use_guided_sampler(ompl::base::SpaceInformation& si, const std::shared_ptr<GuidedSource>& source);

}  // namespace lrrt
