// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/objectives/PathLengthOptimizationObjective.h>

#include <memory>
#include <optional>

#include "lrrt/map/clearance_surcharge.hpp"
#include "lrrt/ompl/map_projection.hpp"
#include "lrrt/ompl/map_validity.hpp"
#include "lrrt/ompl/pose_motion.hpp"

namespace lrrt {

/// A path's length and what it costs to come too near to obstacles on it, see ClearanceSurcharge, of the reference
/// point, along straight lines exactly, along arcs as along their chords of at most a pixel.
///
/// A path costs at least its length, so what holds of the length as a lower bound (heuristics, informed samples) stays
/// true.
class ClearanceObjective final : public ompl::base::PathLengthOptimizationObjective {
 public:
  /// @param clearance with a distance above 0. @param map where the robot's reference point may be.
  ClearanceObjective(const ompl::base::SpaceInformationPtr& si, std::shared_ptr<const CollisionMap> map,
                     std::shared_ptr<const MapProjection> projection, const ClearanceCost& clearance);
  /// The length of a motion and what it costs to come near to obstacles.
  ompl::base::Cost motionCost(const ompl::base::State* from, const ompl::base::State* to) const override;
  /// A Reeds-Shepp curve back may be another one of the same length, which passes elsewhere.
  bool isSymmetric() const override;

 private:
  double along_arcs(const PoseMotion& motion) const;

  std::shared_ptr<const CollisionMap> map_;
  std::shared_ptr<const MapProjection> projection_;
  std::optional<Steering> steering_;  ///< where motions are arcs
  ClearanceSurcharge surcharge_;
};

}  // namespace lrrt
