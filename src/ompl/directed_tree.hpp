// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/datastructures/NearestNeighborsSqrtApprox.h>

#include "lrrt/ompl/forward_space.hpp"

namespace lrrt {

/// The nodes of one of two trees of a planner in a space where the way back is another one.
///
/// OMPL's planners check motions in the direction in which a path uses them, but extend the tree that ends at the goal
/// along curves that lead away from it: most of them are then of no use to it. They ask for the nearest node right
/// before they extend, which is when the space can be told the tree's direction.
template <typename Motion>
class DirectedTree final : public ompl::NearestNeighborsSqrtApprox<Motion> {
 public:
  /// @param space must outlive this. @param backwards whether the tree's motions lead to its root.
  DirectedTree(ForwardSpace& space, bool backwards) : space_(space), backwards_(backwards) {}

  Motion nearest(const Motion& motion) const override {
    space_.set_backwards(backwards_);
    return ompl::NearestNeighborsSqrtApprox<Motion>::nearest(motion);
  }

 private:
  ForwardSpace& space_;
  bool backwards_;
};

}  // namespace lrrt
