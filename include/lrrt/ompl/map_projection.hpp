// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/StateSpace.h>

#include <Eigen/Core>
#include <memory>

namespace lrrt {

/// An angle in [-π, π), the range of OMPL's SO2StateSpace; within it the angle itself.
double wrapped_angle(double angle);

/// The shorter way from one angle to another, radians, never negative.
double angle_between(double a, double b);

/// How a state space touches the map: where a state stands in the map's plane, in map units.
class MapProjection {
 public:
  virtual ~MapProjection() = default;
  /// Position of a state, map units.
  virtual Eigen::Vector2d read(const ompl::base::State* state) const = 0;
  /// Moves a state to a position, map units; leaves its other coordinates as they are.
  virtual void write(const Eigen::Vector2d& position, ompl::base::State* state) const = 0;
  /// True when a state has no other coordinates than its position and, where it has one, its heading.
  virtual bool is_whole_state() const { return false; }
  /// True when a state has a heading that guidance may choose; the next two then have to be overridden.
  virtual bool has_heading() const { return false; }
  /// Heading of a state: radians from the map's x axis towards its y axis.
  virtual double read_heading(const ompl::base::State* /*state*/) const { return 0.0; }
  /// Turns a state to a heading, any number of radians; leaves its other coordinates as they are.
  virtual void write_heading(double /*angle*/, ompl::base::State* /*state*/) const {}
  /// False when the robot moves along its heading only, never backwards.
  virtual bool can_reverse() const { return true; }
};

/// The plane itself: OMPL's RealVectorStateSpace with (x, y) as its first two coordinates.
class PlaneProjection final : public MapProjection {
 public:
  Eigen::Vector2d read(const ompl::base::State* state) const override;
  void write(const Eigen::Vector2d& position, ompl::base::State* state) const override;
  bool is_whole_state() const override { return true; }
};

/// Poses: OMPL's SE2StateSpace and those that derive from it, Dubins and Reeds-Shepp.
class PoseProjection final : public MapProjection {
 public:
  /// @param can_reverse false for a robot that only drives forwards, as in OMPL's Dubins space.
  explicit PoseProjection(bool can_reverse = true) : can_reverse_(can_reverse) {}
  Eigen::Vector2d read(const ompl::base::State* state) const override;
  void write(const Eigen::Vector2d& position, ompl::base::State* state) const override;
  bool is_whole_state() const override { return true; }
  bool has_heading() const override { return true; }
  double read_heading(const ompl::base::State* state) const override;
  /// Writes the wrapped_angle().
  void write_heading(double angle, ompl::base::State* state) const override;
  bool can_reverse() const override { return can_reverse_; }

 private:
  bool can_reverse_;
};

/// The projection of a state space of OMPL: a PoseProjection for SE2StateSpace and those that derive from it, else a
/// PlaneProjection.
std::shared_ptr<const MapProjection> projection_of(const ompl::base::StateSpace& space);

}  // namespace lrrt
