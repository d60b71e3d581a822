// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lrrt {

/// The share of a motion up to which it is free, found by bisection, for OMPL's `last_valid`.
/// @param is_free_until whether the motion is free from its beginning to a share in [0, 1]; it is not to 1.
template <typename IsFreeUntil>
double last_free_share(const IsFreeUntil& is_free_until) {
  double free = 0.0;
  double blocked = 1.0;
  for (int i = 0; i < 30; ++i) {
    const double middle = (free + blocked) / 2.0;
    (is_free_until(middle) ? free : blocked) = middle;
  }
  return free;
}

}  // namespace lrrt
