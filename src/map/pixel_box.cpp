// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/map/pixel_box.hpp"

#include <algorithm>
#include <cmath>

namespace lrrt {

PixelBox united(const PixelBox& a, const PixelBox& b) {
  const int c = std::min(a.c, b.c);
  const int r = std::min(a.r, b.r);
  return {c, r, std::max(a.c + a.width, b.c + b.width) - c, std::max(a.r + a.height, b.r + b.height) - r};
}

PixelBox widened(const PixelBox& box, double by) {
  const int margin = static_cast<int>(std::min(std::ceil(by), 1e6));
  return {box.c - margin, box.r - margin, box.width + 2 * margin, box.height + 2 * margin};
}

PixelBox clipped(const PixelBox& box, int width, int height) {
  const int c = std::clamp(box.c, 0, width - 1);
  const int r = std::clamp(box.r, 0, height - 1);
  return {c, r, std::clamp(box.c + box.width - c, 1, width - c), std::clamp(box.r + box.height - r, 1, height - r)};
}

bool overlap(const PixelBox& a, const PixelBox& b) {
  return a.c < b.c + b.width && b.c < a.c + a.width && a.r < b.r + b.height && b.r < a.r + a.height;
}

}  // namespace lrrt
