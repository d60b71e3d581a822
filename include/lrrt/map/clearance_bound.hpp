// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "lrrt/map/distance_field.hpp"
#include "lrrt/map/occupancy_map.hpp"

namespace lrrt {

/// At least how far every free pixel is from what is not free: all that a collision check needs for its leaps.
///
/// On maps of up to 1024 pixels a side, unless told otherwise, it is the distance field. On larger ones it is that of
/// the coarsened map, which takes a sixteenth of the time and the memory at 4096 pixels, less what coarsening may hide.
///
/// Holds a reference: the map must outlive it. Safe to share between threads.
class ClearanceBound {
 public:
  /// Computes the field. @param most_side its longest side, pixels.
  explicit ClearanceBound(const OccupancyMap& map, int most_side = 1024);

  /// A lower bound of the distance, in pixels, from the centre of a pixel to that of the nearest one that is not free;
  /// above 0 for a free pixel, 0 for another one and outside the map.
  float at(Pixel p) const { return shift_ == 0 ? field_.at(p) : at_block(p); }
  /// The distance field, or that of the map coarsened by coarseness().
  const DistanceField& field() const { return field_; }
  /// Pixels along the side of a pixel of the field; 1 when the bound is the distance itself.
  int coarseness() const { return 1 << shift_; }

 private:
  float at_block(Pixel p) const {
    if (!map_.is_free(p)) return 0.0F;
    // Centres of pixels lie at most half a block less half a pixel from that of their block, along either axis.
    const float between = field_.at({p.c >> shift_, p.r >> shift_});
    return std::max(1.0F, static_cast<float>(coarseness()) * between - hidden_);
  }

  const OccupancyMap& map_;
  int shift_;
  float hidden_;
  DistanceField field_;
};

}  // namespace lrrt
