// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/spaces/DubinsStateSpace.h>

namespace lrrt {

/// OMPL's Dubins space with curves of our own: those of OMPL's 1.5 and 1.6 assert what rounding breaks for poses that
/// lie nearly in line, which ends the process where OMPL was built with assertions, as Debian's is.
class ForwardSpace : public ompl::base::DubinsStateSpace {
 public:
  /// @param turning_radius tightest one, above 0, in the space's unit of length.
  explicit ForwardSpace(double turning_radius) : ompl::base::DubinsStateSpace(turning_radius) {}

  /// The shortest curve of at most three arcs and straight lines, for a turning radius of 1 (Dubins 1957).
  DubinsPath curve(const ompl::base::State* from, const ompl::base::State* to) const;

  /// For a tree that grows backwards from the goal: distance() and interpolate() then take the curve that leads from
  /// the second state to the first, and curve() does not change.
  /// A space serves one such tree at a time.
  void set_backwards(bool backwards) { backwards_ = backwards; }

  /// Length of the curve; the way back may have another.
  double distance(const ompl::base::State* from, const ompl::base::State* to) const override {
    return rho_ * (backwards_ ? curve(to, from) : curve(from, to)).length();
  }
  using ompl::base::DubinsStateSpace::interpolate;
  /// The state at a share t of the curve, in [0, 1].
  void interpolate(const ompl::base::State* from, const ompl::base::State* to, double t,
                   ompl::base::State* state) const override;
  /// @param first_time whether the path is still to be found; it is false afterwards.
  void interpolate(const ompl::base::State* from, const ompl::base::State* to, double t, bool& first_time,
                   DubinsPath& path, ompl::base::State* state) const override;

 private:
  bool backwards_ = false;
};

}  // namespace lrrt
