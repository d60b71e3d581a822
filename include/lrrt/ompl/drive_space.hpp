// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/control/SpaceInformation.h>
#include <ompl/control/StatePropagator.h>
#include <ompl/control/spaces/RealVectorControlSpace.h>
#include <ompl/util/RandomNumbers.h>

#include <atomic>
#include <cstdint>
#include <memory>

#include "lrrt/ompl/drive.hpp"
#include "lrrt/ompl/pose_validity.hpp"
#include "lrrt/ompl/search_limits.hpp"

namespace lrrt {

/// Poses of a driven robot and the time that it took to get there: OMPL's SE(2) with a third component, which tells
/// what a way costs and counts for nothing else.
class DriveSpace : public ompl::base::SE2StateSpace {
 public:
  /// @param turn_weight what a radian counts beside a length, map units.
  explicit DriveSpace(double turn_weight);

  /// A new state's time is 0.
  ompl::base::State* allocState() const override;
  /// Of position and heading; the time counts for nothing.
  double distance(const ompl::base::State* a, const ompl::base::State* b) const override;

  /// Seconds since the start.
  static double time(const ompl::base::State* state);
  /// Sets the seconds since the start.
  static void set_time(double seconds, ompl::base::State* state);

 private:
  double turn_weight_;
};

/// Controls (speed, turn rate) within the limits of a Drive, drawn by numbers of its own.
class DriveControlSpace : public ompl::control::RealVectorControlSpace {
 public:
  /// @param seed not 0.
  DriveControlSpace(const ompl::base::StateSpacePtr& space, const Drive& drive, std::uint32_t seed);
  /// A sampler that draws by Drive::draw().
  ompl::control::ControlSamplerPtr allocDefaultControlSampler() const override;

  /// The speed and the turn rate of one of this space's controls, for a duration, seconds.
  static lrrt::Control read(const ompl::control::Control* control, double duration);

 private:
  Drive drive_;
  std::uint32_t seed_;
};

/// Drives a robot with a body along exact arcs. Where it would touch something on its way it gets nowhere: the
/// coordinates of the result are no numbers, which no validity checker takes for free. So OMPL's control planners, that
/// only look at the states at which steps end, check every moment between them.
class DrivePropagator final : public ompl::control::StatePropagator {
 public:
  /// @param limits when given, the robot gets nowhere any more once they say that the search must end.
  DrivePropagator(const ompl::control::SpaceInformationPtr& si, std::shared_ptr<const CollisionBody> body,
                  std::shared_ptr<SearchLimits> limits = nullptr);
  /// @param duration seconds; a turn on the spot must be of less than half a turn.
  void propagate(const ompl::base::State* state, const ompl::control::Control* control, double duration,
                 ompl::base::State* result) const override;
  /// What a control leads to is known forwards only.
  bool canPropagateBackward() const override { return false; }

  /// How many steps were checked so far.
  std::size_t checks() const { return checks_; }

 private:
  std::shared_ptr<const CollisionBody> body_;
  double reach_;
  std::shared_ptr<SearchLimits> limits_;
  mutable std::atomic<std::size_t> checks_{0};
};

/// The time of a way in a DriveSpace, seconds.
class DurationObjective final : public ompl::base::OptimizationObjective {
 public:
  /// @param top_speed map units per second.
  DurationObjective(const ompl::base::SpaceInformationPtr& si, double top_speed);
  /// Being somewhere costs nothing.
  ompl::base::Cost stateCost(const ompl::base::State* state) const override;
  /// Seconds from state to state.
  ompl::base::Cost motionCost(const ompl::base::State* from, const ompl::base::State* to) const override;
  /// The way back may take another time.
  bool isSymmetric() const override { return false; }
  /// Greatest speed in either direction, map units per second.
  double top_speed() const { return top_speed_; }

 private:
  double top_speed_;
};

/// Poses near a goal, by position and by heading. Its samples lie at the goal's position and have any heading that it
/// takes.
class PoseGoal final : public ompl::base::GoalSampleableRegion {
 public:
  /// @param tolerance map units, above 0. @param heading_tolerance radians, above 0. @param seed not 0.
  PoseGoal(const ompl::base::SpaceInformationPtr& si, const Pose2& goal, double tolerance, double heading_tolerance,
           std::uint32_t seed);
  /// The larger of the two distances, each as a share of its tolerance: 1 at the region's edge.
  double distanceGoal(const ompl::base::State* state) const override;
  /// A pose at the goal with a heading that it takes.
  void sampleGoal(ompl::base::State* state) const override;
  /// One place.
  unsigned int maxSampleCount() const override { return 1; }
  /// The goal itself.
  const Pose2& pose() const { return goal_; }
  /// Greatest distance from the goal, map units.
  double tolerance() const { return tolerance_; }

 private:
  Pose2 goal_;
  double tolerance_;
  double heading_tolerance_;
  mutable ompl::RNG random_;
};

}  // namespace lrrt
