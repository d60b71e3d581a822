// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/map/clearance_bound.hpp"

namespace lrrt {
namespace {

/// Of a power of two.
int logarithm(int power) {
  int result = 0;
  while (power >> result > 1) ++result;
  return result;
}

}  // namespace

ClearanceBound::ClearanceBound(const OccupancyMap& map, int most_side)
    : map_(map),
      shift_(logarithm(map.coarsening_to(most_side))),
      hidden_(static_cast<float>(std::sqrt(2.0) * (coarseness() - 1))),
      field_(shift_ == 0 ? DistanceField(map) : DistanceField(map.coarsened(coarseness()))) {}

}  // namespace lrrt
