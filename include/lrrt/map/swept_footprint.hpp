// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "lrrt/map/distance_field.hpp"
#include "lrrt/map/occupancy_map.hpp"
#include "lrrt/map/polygon.hpp"

namespace lrrt {

/// Collision check of a robot with a polygon for its outline, at a pose and along a motion.
///
/// A pose is free exactly when the polygon, its outline and its inside, touches no pixel that is not free; everything
/// outside the map counts as not free, and what is nearer than 1e-9 pixels touches. A motion that is called free is
/// free at every moment; one that is refused comes nearer than the tolerance to something that is not free.
///
/// Poses are in map units, the heading in radians from the map's x axis towards its y axis: counter-clockwise on a map
/// in metres, clockwise to the eye on a plain picture, whose y axis points down.
///
/// Cost: where the robot's circumscribed disc is clear, or its inscribed one is not, a pose costs one look-up of the
/// distance field. Else its edges are walked in leaps as long as the field allows, with a look at the single pixels
/// where it does not: 0.3 to 1.5 µs on the mean. A motion asks for the clearance of as many poses as it takes for them
/// to cover it, about its length over its clearance, often fewer than five: 1 to 4 µs on the mean, up to 0.3 ms for one
/// of 40 pixels right along a wall. Nothing is allocated.
///
/// Holds references: map and field must outlive the walk. Safe to share between threads.
class FootprintWalk {
 public:
  /// @param map not inflated. @param field of the same map.
  /// @param tolerance pixels, from 1e-6 to 1: motions that come nearer than this to an obstacle may be refused.
  /// @throws RequestError when the sizes of map and field differ or the tolerance is out of its range.
  FootprintWalk(const OccupancyMap& map, const DistanceField& field, Polygon polygon, double tolerance = 0.05);

  /// The robot's outline.
  const Polygon& polygon() const { return polygon_; }
  /// Pixels: motions that come nearer than this to an obstacle may be refused.
  double tolerance() const { return tolerance_; }

  /// True when the robot touches nothing at a pose. A pose that is not finite is not free.
  bool is_free(const Pose2& pose) const;

  /// True when the robot touches nothing from the beginning of a motion to its end; both poses are then free too.
  ///
  /// The clearance at one moment covers the time in which the robot cannot move as far; what is left before and after
  /// is asked in the same way (Schwarzer, Saha, Latombe 2005, "Adaptive dynamic collision checking").
  /// @param pose_at callable that gives the pose at any t in [0, 1], as a Pose2.
  /// @param speed no point of the robot moves farther than speed · |t1 − t0| map units between t0 and t1. For a
  /// straight motion that turns evenly: its length plus circumscribed_radius() · |change of heading|. Not finite or
  /// negative: the motion is not free.
  template <typename PoseAt>
  bool is_free(const PoseAt& pose_at, double speed) const {
    const double pixels = speed / map_.resolution();
    return pixels >= 0.0 && pixels < unbounded && is_free(pose_at(1.0)) && stays_clear(pose_at, pixels, 0.0, 1.0);
  }

 private:
  /// The robot at a pose, in pixel coordinates.
  struct Placed {
    Eigen::Vector2d position;
    Eigen::Matrix2d frame;  ///< turns the robot's frame, in map units, into pixels

    Eigen::Vector2d pixel_of(const Eigen::Vector2d& vertex) const { return position + frame * vertex; }
    /// The way back: the frame is a rotation, perhaps mirrored, times one scale.
    Eigen::Vector2d vertex_of(const Eigen::Vector2d& pixel) const {
      return frame.transpose() * (pixel - position) / frame.col(0).squaredNorm();
    }
  };

  /// Nothing moves this many pixels: the widest map has 2^28.
  static constexpr double unbounded = 1e12;
  /// A gap below this, in pixels, is none: coordinates are rounded.
  static constexpr double touching = 1e-9;

  /// Whether the outline touches nothing between two moments. @param speed pixels per unit of t.
  template <typename PoseAt>
  bool stays_clear(const PoseAt& pose_at, double speed, double from, double to) const {
    const double middle = (from + to) / 2.0;
    const double wanted = speed * (to - from) / 2.0 + touching;
    const double gap = clearance(placed(pose_at(middle)), wanted);
    if (gap >= wanted) return true;
    if (gap <= tolerance_) return false;
    const double covered = (gap - touching) / speed;
    return stays_clear(pose_at, speed, from, middle - covered) && stays_clear(pose_at, speed, middle + covered, to);
  }

  /// A pose that is not finite puts the robot nowhere: its position is not a number.
  Placed placed(const Pose2& pose) const;
  /// Lower bound of the distance, in pixels, from the outline to everything that is not free, at most `wanted`. It is
  /// at or below the tolerance only where the distance is.
  double clearance(const Placed& robot, double wanted) const;
  /// Whether nothing lies inside an outline that touches nothing.
  bool is_hollow(const Placed& robot) const;
  bool row_is_hollow(const Placed& robot, int row) const;

  const OccupancyMap& map_;
  const DistanceField& field_;
  Polygon polygon_;
  double tolerance_;
  double inscribed_;           ///< pixels; below zero when the reference point is outside
  double circumscribed_;       ///< pixels
  Eigen::Matrix2d to_pixels_;  ///< turns a difference in map units into one in pixels
};

}  // namespace lrrt
