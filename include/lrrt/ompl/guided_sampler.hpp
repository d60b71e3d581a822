// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/StateSampler.h>
#include <ompl/base/ValidStateSampler.h>

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "lrrt/map/occupancy_map.hpp"
#include "lrrt/ompl/map_projection.hpp"
#include "lrrt/sampling/mixed_sampler.hpp"

namespace lrrt {

/// A sampler, and the map in whose pixels it speaks: one that may have larger pixels than the map that motions are
/// checked on.
struct MapSampler {
  std::shared_ptr<const OccupancyMap> map;  ///< the map
  MixedSampler points;                      ///< the sampler
};

/// Where guided states come from: points of the map drawn by a MixedSampler, brought to map units. One source may feed
/// several samplers of the same planner, so that its counts cover them all. Not for concurrent use.
///
/// In spaces whose states have a heading most guided states look along the region towards the goal, as far as the
/// strategy knows the way, with a spread; where the robot can reverse some look back. The others look anywhere, so that
/// every pose keeps a positive density.
class GuidedSource {
 public:
  /// @param start,goal map units.
  GuidedSource(MapSampler sampler, std::shared_ptr<const MapProjection> projection, const Eigen::Vector2d& start,
               const Eigen::Vector2d& goal)
      : map_(std::move(sampler.map)),
        sampler_(std::move(sampler.points)),
        projection_(std::move(projection)),
        start_(map_->to_pixel(start)),
        goal_(map_->to_pixel(goal)) {}

  /// Tells how a search ends within an iteration: some planners of OMPL draw until a state is free and could shorten
  /// the path, and look at no clock meanwhile. @param over true once the search must end; asked at every draw.
  /// @param free a state that is free then; must outlive this.
  void end_with(std::function<bool()> over, const ompl::base::State* free) {
    over_ = std::move(over);
    free_ = free;
  }
  /// True once the search must end.
  bool over() const { return over_ && over_(); }
  /// Gives the free state instead of a drawn one once the search must end. @return whether it did.
  bool ended(const ompl::base::StateSpace& space, ompl::base::State* state) const {
    if (!over()) return false;
    space.copyState(state, free_);
    return true;
  }

  /// The next state: position and heading from the sampler, its other coordinates from OMPL's own one.
  void place(ompl::base::State* state, ompl::base::StateSampler& other);
  /// A guided state, not counted.
  void place_guided(ompl::base::State* state, ompl::base::StateSampler& other);
  /// A state near another one. Where position and heading are all, the source draws them, so that the seed decides.
  void place_near(ompl::base::State* state, const ompl::base::State* near, double distance,
                  ompl::base::StateSampler& other);
  /// True where a state is its position, or position and heading: then the source draws all of it.
  bool places_whole_states() const { return projection_->is_whole_state(); }
  /// A uniform state over which a path could be shorter than `length` (map units, infinite for any). For whole states.
  void place_informed(ompl::base::State* state, double length);
  /// True when the next draw shall be a guided one, see MixedSampler.
  bool wants_guided() { return sampler_.wants_guided(); }
  /// Counts a draw that another sampler made, guided or not.
  void count(bool guided) { sampler_.count(guided); }
  /// True for a state that a guided draw could give.
  bool promising(const ompl::base::State* state) const { return sampler_.promising(pixel_point(state)); }
  /// Tells the sampler that a motion is free, so that it can follow the tree.
  void connected(const ompl::base::State* from, const ompl::base::State* to) { connected(pixel_point(from), to); }
  /// The same for a motion whose beginning is a point, pixel coordinates.
  void connected(const Eigen::Vector2d& from, const ompl::base::State* to) {
    sampler_.connected(from, pixel_point(to));
  }
  /// Tells the sampler of a better path.
  /// @param states its states in either order, with or without start and goal, as OMPL's planners report them.
  /// @param length map units; infinite where the cost of the path is no length.
  void improved(const std::vector<const ompl::base::State*>& states, double length);
  /// How many states were guided and how many uniform.
  DrawCounts counts() const { return sampler_.counts(); }
  /// Where a state stands, pixel coordinates.
  Eigen::Vector2d pixel_point(const ompl::base::State* state) const { return map_->to_pixel(projection_->read(state)); }

 private:
  /// Moves a state to a point, pixel coordinates, and its other coordinates anywhere.
  void write(const Eigen::Vector2d& point, ompl::base::State* state, ompl::base::StateSampler& other);
  /// Moves a state whose position and heading are all to a point, pixel coordinates, and turns it anywhere.
  void write_whole(const Eigen::Vector2d& point, ompl::base::State* state);
  /// Turns a guided state at a point, pixel coordinates, to the way on from there, more often than not.
  void align(const Eigen::Vector2d& point, ompl::base::State* state);

  std::shared_ptr<const OccupancyMap> map_;
  MixedSampler sampler_;
  std::shared_ptr<const MapProjection> projection_;
  Eigen::Vector2d start_;  // pixel coordinates
  Eigen::Vector2d goal_;
  std::function<bool()> over_;
  const ompl::base::State* free_ = nullptr;
};

/// The paper's biased sampler as OMPL's ValidStateSampler: only collision-free states. For planners such as PRM.
class GuidedValidStateSampler final : public ompl::base::ValidStateSampler {
 public:
  /// A sampler of a source, which others may share.
  GuidedValidStateSampler(const ompl::base::SpaceInformation* si, std::shared_ptr<GuidedSource> source);
  /// False when no free state was found within OMPL's number of attempts.
  bool sample(ompl::base::State* state) override;
  /// A free state near another one; with probability α one of the promising region, where any lies near.
  bool sampleNear(ompl::base::State* state, const ompl::base::State* near, double distance) override;

 private:
  std::shared_ptr<GuidedSource> source_;
  ompl::base::StateSamplerPtr uniform_;
};

/// The same source as OMPL's StateSampler, whose states may be in collision. For planners such as RRT and RRT*.
class GuidedStateSampler final : public ompl::base::StateSampler {
 public:
  /// A sampler of a source, which others may share.
  GuidedStateSampler(const ompl::base::StateSpace* space, std::shared_ptr<GuidedSource> source);
  /// The source's next state, guided or uniform.
  void sampleUniform(ompl::base::State* state) override;
  /// A state at most `distance` away from another one, map units.
  void sampleUniformNear(ompl::base::State* state, const ompl::base::State* near, double distance) override;
  /// A state around another one, as OMPL draws it, without guidance.
  void sampleGaussian(ompl::base::State* state, const ompl::base::State* mean, double deviation) override;

 private:
  std::shared_ptr<GuidedSource> source_;
  ompl::base::StateSamplerPtr uniform_;
};

/// Checks motions by another validator and tells the source of those that are free.
class ObservingMotionValidator final : public ompl::base::MotionValidator {
 public:
  /// @param inner what decides. @param source what is told.
  ObservingMotionValidator(ompl::base::SpaceInformation* si, ompl::base::MotionValidatorPtr inner,
                           std::shared_ptr<GuidedSource> source);
  /// What `inner` says.
  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to) const override;
  /// What `inner` says, and its last valid state.
  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to,
                   std::pair<ompl::base::State*, double>& last_valid) const override;

 private:
  bool noted(bool free, const ompl::base::State* from, const ompl::base::State* to) const;

  ompl::base::MotionValidatorPtr inner_;
  std::shared_ptr<GuidedSource> source_;
};

}  // namespace lrrt
