// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/State.h>

#include <Eigen/Core>

namespace lrrt {

/// How a state space touches the map: where a state stands in the map's plane, in map units.
class MapProjection {
 public:
  virtual ~MapProjection() = default;
  /// Position of a state, map units.
  virtual Eigen::Vector2d read(const ompl::base::State* state) const = 0;
  /// Moves a state to a position, map units; leaves its other coordinates as they are.
  virtual void write(const Eigen::Vector2d& position, ompl::base::State* state) const = 0;
  /// True when a state has no other coordinates than its position.
  virtual bool is_whole_state() const { return false; }
};

/// The plane itself: OMPL's RealVectorStateSpace with (x, y) as its first two coordinates.
class PlaneProjection final : public MapProjection {
 public:
  Eigen::Vector2d read(const ompl::base::State* state) const override;
  void write(const Eigen::Vector2d& position, ompl::base::State* state) const override;
  bool is_whole_state() const override { return true; }
};

}  // namespace lrrt
