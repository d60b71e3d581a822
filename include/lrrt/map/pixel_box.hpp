// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lrrt {

/// Axis-aligned box of pixels: columns [c, c + width), rows [r, r + height).
struct PixelBox {
  int c = 0;       ///< first column
  int r = 0;       ///< first row
  int width = 0;   ///< columns
  int height = 0;  ///< rows
};

/// Smallest box that holds both boxes.
PixelBox united(const PixelBox& a, const PixelBox& b);

/// A box with so many pixels more on every side, rounded up.
PixelBox widened(const PixelBox& box, double by);

/// The part of a box on a picture; of one beside it, the pixels of the picture that are nearest.
PixelBox clipped(const PixelBox& box, int width, int height);

/// True when two boxes share a pixel.
bool overlap(const PixelBox& a, const PixelBox& b);

}  // namespace lrrt
