// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "lrrt/map/occupancy_map.hpp"

namespace lrrt {

/// Where a path probably lies (the paper, section III): a probability for every pixel of a map and the mask that
/// follows.
class PromisingRegion {
 public:
  /// @param probability row-major, one value in [0, 1] per pixel of the map; NaN counts as 0.
  /// @param threshold a free pixel belongs to the mask from this probability on, in (0, 1].
  /// @throws RequestError when the sizes do not fit or the threshold is out of range.
  PromisingRegion(const OccupancyMap& map, std::vector<float> probability, Pixel start, Pixel goal,
                  float threshold = 0.5F);

  /// Columns.
  int width() const { return width_; }
  /// Rows.
  int height() const { return height_; }
  /// OccupancyMap::coarseness() of the map that the region was predicted for: above 1 for a region on larger pixels.
  int coarseness() const { return coarseness_; }
  /// Row-major probability of the promising class, width × height values.
  const std::vector<float>& probability() const { return probability_; }
  /// Row-major, 1 where a pixel is free and promising, else 0.
  const std::vector<std::uint8_t>& mask() const { return mask_; }
  /// Number of pixels in the mask.
  std::size_t area() const { return area_; }
  /// True when one can walk from start to goal inside the mask without touching any other pixel.
  bool connected() const { return connected_; }
  /// Number of pixels below the threshold that linked() added to the mask.
  std::size_t link_area() const { return link_area_; }
  /// Number of pixels that bridged() added to the mask; 0 for a region as it was predicted.
  std::size_t bridge_area() const { return bridge_area_; }
  /// The middle lines of the bridges: the pixels of the way from start to goal that the prediction lacked.
  const std::vector<Pixel>& bridge() const { return bridge_; }

  /// @throws RequestError when the map has another size than the one the region was made for.
  void check_belongs_to(const OccupancyMap& map) const;

  /// The region with its weak spots taken in: where the threshold leaves start and goal apart, the pixels on the way
  /// whose least probability is the highest join it, and their neighbours that are at least as probable as `lowest`. It
  /// is what a threshold that sinks until start and goal meet would find, without what it would add elsewhere.
  /// @param lowest least probability of a pixel that joins, in [0, 1]. @param halo half the width of a link, pixels.
  /// @return the region itself when it is connected or no such way exists.
  /// @throws RequestError when the map has another size or an argument is out of range.
  PromisingRegion linked(const OccupancyMap& map, Pixel start, Pixel goal, float lowest, int halo = 3) const;

  /// Takes out of the mask what does not hang together with the start: no path to the goal runs there without leaving
  /// the region. A region that does not join start and goal stays whole, since any part may be a stepping stone.
  void drop_loose_parts(Pixel start);

  /// The region with its gaps closed: start and goal are joined along the way that leaves the mask for the fewest
  /// pixels, and that way is widened within free space. Predicted regions do break, and a broken one guides into a dead
  /// end.
  /// @param halo half the width of a bridge, pixels. @return the region itself when it is connected or cannot be.
  /// @throws RequestError when the map has another size or the halo is negative.
  PromisingRegion bridged(const OccupancyMap& map, Pixel start, Pixel goal, int halo = 3) const;

 private:
  int width_;
  int height_;
  int coarseness_;
  std::vector<float> probability_;
  std::vector<std::uint8_t> mask_;
  std::size_t area_;
  bool connected_;
  std::size_t link_area_ = 0;
  std::size_t bridge_area_ = 0;
  std::vector<Pixel> bridge_;
};

}  // namespace lrrt
