// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "lrrt/map/occupancy_map.hpp"

namespace lrrt {

/// The connected components of a set of pixels.
///
/// Neighbours share an edge: a motion that touches no blocked pixel cannot pass between two diagonal ones, so two free
/// points are joined by a free path exactly when they lie in the same component.
class Components {
 public:
  /// Components of the free pixels of a map.
  explicit Components(const OccupancyMap& map);
  /// Components of the pixels whose mask is not zero. @param mask row-major, width × height values.
  Components(int width, int height, const std::vector<std::uint8_t>& mask);

  /// True when both pixels belong to the set and one can walk from one to the other inside it.
  bool joined(Pixel a, Pixel b) const;
  /// Number of the component that holds a pixel, from 1; 0 for a pixel outside the set.
  int label(Pixel p) const;
  /// Smallest box that holds a component. @param label from 1 to count().
  const PixelBox& box(int label) const { return boxes_[static_cast<std::size_t>(label)]; }
  /// Number of pixels of a component. @param label from 1 to count().
  int area(int label) const { return areas_[static_cast<std::size_t>(label)]; }
  /// Number of components.
  int count() const { return static_cast<int>(boxes_.size()) - 1; }

 private:
  int width_;
  int height_;
  std::vector<std::int32_t> labels_;
  std::vector<PixelBox> boxes_;
  std::vector<int> areas_;
};

}  // namespace lrrt
