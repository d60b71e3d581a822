// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lrrt/ompl/pose_motion.hpp"
#include "lrrt/plan.hpp"

namespace lrrt {

/// How a robot can be driven: the limits of its controls.
///
/// Speeds may jump from one control to the next, so nothing is gained by driving an arc slower than it can be driven:
/// draw() only gives the fastest control of each arc. A unicycle takes tight arcs slower, by its turn rate; a car takes
/// every arc at full speed, but none tighter than its turning radius.
class Drive {
 public:
  /// @param request of a driven motion, with its numbers checked.
  explicit Drive(const PlanRequest& request);

  /// A control of which every arc has a positive density, its duration 0. Straight lines and, for a unicycle, turns on
  /// the spot come up by themselves, too.
  /// @param choice,speed,turn each in [0, 1).
  Control draw(double choice, double speed, double turn) const;
  /// True when a control keeps the limits, but for rounding. Tells nothing of its duration.
  bool allows(const Control& control) const;

  /// Greatest speed forwards, map units per second.
  double speed() const { return speed_; }
  /// False for a robot that only drives forwards.
  bool can_reverse() const { return reverse_speed_ > 0.0; }
  /// Greatest speed in either direction, map units per second.
  double top_speed() const;
  /// Greatest turn rate at any speed, radians per second.
  double top_turn_rate() const;

 private:
  bool is_car_;
  double speed_;
  double reverse_speed_;
  double turn_rate_;
  double turning_radius_;
};

/// Where a control leads: its arc in closed form, without steps.
Pose2 driven(const Pose2& from, const Control& control);

/// The motion of a control, for collision checks. A turn on the spot must be of less than half a turn.
/// @param reach see PoseMotion.
PoseMotion motion_of(const Pose2& from, const Control& control, double reach);

}  // namespace lrrt
