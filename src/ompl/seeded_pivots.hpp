// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/SpaceInformation.h>
#include <ompl/datastructures/NearestNeighborsGNATNoThreadSafety.h>

#include <cstdint>
#include <memory>

namespace lrrt {

/// The nearest neighbours that OMPL's planners take in a metric space, with pivots that a seed decides.
///
/// OMPL's draw them from a generator of their own, which is seeded by how many generators the process has made before.
/// The answers should not depend on pivots, but distances are rounded, and those of Reeds-Shepp curves keep the
/// triangle inequality only nearly: once in some thousand searches other pivots meant another tree.
template <typename Node>
class SeededPivots final : public ompl::NearestNeighborsGNATNoThreadSafety<Node> {
 public:
  explicit SeededPivots(std::uint64_t seed) {
    (this->pivotSelector_.*Selector::generator()).setLocalSeed(static_cast<std::uint_fast32_t>(seed));
  }

 private:
  /// The generator is protected: only a kind of selector may name it.
  struct Selector : ompl::GreedyKCenters<Node> {
    static ompl::RNG ompl::GreedyKCenters<Node>::*generator() { return &Selector::rng_; }
  };
};

/// Chooses the nearest neighbours of a planner before its setup() does: those that it has are kept, and spaces that are
/// no metric ones are left to OMPL, which takes a structure without random numbers there.
template <typename Node>
void seed_pivots(std::shared_ptr<ompl::NearestNeighbors<Node>>& neighbors, const ompl::base::SpaceInformation& si,
                 std::uint64_t seed) {
  if (neighbors || !si.getStateSpace()->isMetricSpace()) return;
  neighbors = std::make_shared<SeededPivots<Node>>(seed);
}

}  // namespace lrrt
