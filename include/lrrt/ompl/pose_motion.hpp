// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>

#include <array>
#include <cstddef>
#include <vector>

#include "lrrt/map/occupancy_map.hpp"
#include "lrrt/ompl/forward_space.hpp"

namespace lrrt {

/// Where an arc ends, a straight line, or a turn on the spot.
/// @param length map units; negative backwards. @param turn radians; positive from x towards y.
Pose2 along_arc(const Pose2& from, double length, double turn);

/// Length of the one arc, or straight line, from pose to pose, map units; negative where it leads backwards. Where none
/// does, that of one that misses the second pose. The inverse of along_arc().
double arc_length(const Pose2& from, const Pose2& to);

/// The motion between two poses: a straight line with an even turn, or up to five arcs and straight lines.
///
/// Its parameter t runs from 0 to 1 at a pace at which the robot's farthest point could always be moved alike: on arcs,
/// where that point is faster than the reference point, t runs slower. So one bound on the speed holds all along and is
/// no larger than it has to be.
class PoseMotion {
 public:
  /// @param reach distance from the reference point to the robot's farthest point, map units.
  PoseMotion(const Pose2& from, const Pose2& to, double reach);

  /// The one arc or straight line, forwards or backwards, that leads from pose to pose; where none does, one that
  /// misses its end.
  static PoseMotion arc(const Pose2& from, const Pose2& to, double reach);

  /// Appends a piece to a motion of arcs, of which the first call makes this one. @param length map units; negative
  /// backwards. @param curvature 1 / map units; positive turns from x towards y.
  void append(double length, double curvature);

  /// Pose at a t in [0, 1]; exactly the given ones at 0 and 1.
  Pose2 at(double t) const;
  /// No point of the robot moves farther than speed() · |t1 − t0| between t0 and t1. Map units.
  double speed() const { return speed_; }
  /// Moments at which to tell the motion, rising, the last of them 1: between two of them, and from 0 to the first, no
  /// point of the robot moves farther than `spacing`, above 0, and there is a moment wherever arcs and lines meet.
  std::vector<double> moments(double spacing) const;
  /// What OMPL's interpolation calls t: the share of the length.
  double share(double t) const;
  /// How far a motion of arcs ends from where it shall, and any point of the robot with it. Map units.
  double miss() const;

 private:
  struct Piece {
    Pose2 from;
    double length = 0.0;
    double curvature = 0.0;
    double begin = 0.0;  ///< speed bound spent before this piece
    double pace = 1.0;   ///< speed bound spent per length
  };
  const Piece& piece_at(double spent) const;

  Pose2 from_;
  Pose2 to_;
  double turn_;  ///< the shorter way from heading to heading
  double reach_;
  double speed_;
  std::array<Piece, 5> pieces_{};
  std::size_t count_ = 0;  ///< 0 for the straight line with an even turn
  Pose2 end_;              ///< of the pieces so far
};

/// Makes the motions between states of a space of OMPL.
class Steering {
 public:
  /// @param space OMPL's SE2StateSpace, DubinsStateSpace (better: ForwardSpace) or ReedsSheppStateSpace; must outlive
  /// this.
  /// @param reach see PoseMotion.
  /// @throws RequestError for another space, and for a Dubins space that is symmetric.
  Steering(const ompl::base::StateSpace& space, double reach);
  /// The motion from one state to another; the way back may be another one.
  PoseMotion between(const ompl::base::State* from, const ompl::base::State* to) const;

 private:
  ompl::base::DubinsStateSpace::DubinsPath dubins_curve(const ompl::base::State* from,
                                                        const ompl::base::State* to) const;

  const ForwardSpace* forward_;
  const ompl::base::DubinsStateSpace* dubins_;
  const ompl::base::ReedsSheppStateSpace* reeds_shepp_;
  double reach_;
  double turning_radius_ = 0.0;
};

/// The pose of a state of OMPL's SE2StateSpace or one that derives from it.
Pose2 pose_of(const ompl::base::State* state);

}  // namespace lrrt
