// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/map/segment_walk.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lrrt {
namespace {

/// Centre-to-centre distances bound how far a pixel's points can be from a blocked pixel only up to half a diagonal at
/// each end, √2 together; the rest is for rounding.
constexpr double slack = 1.5;
/// Two crossings nearer than this, in pixels, are one corner: quotients that should be equal differ by rounding.
constexpr double corner_width = 1e-9;
/// Below this clearance a leap is hardly longer than a step and costs more.
constexpr float leap_from = 8.0F;

/// One axis of the walk: where the segment crosses from one pixel to the next, as a share of its length.
struct Axis {
  double origin;
  double inverse;  ///< 1 / extent of the segment along this axis
  int step;
  int last;

  Axis(double from, double to, int end)
      : origin(from), inverse(1.0 / (to - from)), step(to < from ? -1 : 1), last(end) {}

  /// Share of the segment at which it leaves the pixel; infinite once the last pixel is reached.
  double leaves(int pixel) const {
    if (pixel == last) return std::numeric_limits<double>::infinity();
    return ((step > 0 ? pixel + 1 : pixel) - origin) * inverse;
  }
};

}  // namespace

bool SegmentWalk::is_free(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  const Pixel first = OccupancyMap::pixel_of(from);
  const Pixel last = OccupancyMap::pixel_of(to);
  if (clearance_.at(first) <= 0.0F || clearance_.at(last) <= 0.0F) return false;
  const Axis x(from.x(), to.x(), last.c);
  const Axis y(from.y(), to.y(), last.r);
  const Eigen::Vector2d direction = to - from;
  const double length = direction.norm();
  Pixel pixel = first;
  double travelled = 0.0;
  while (pixel != last) {
    const float clearance = clearance_.at(pixel);
    if (clearance <= 0.0F) return false;
    const double leave_x = x.leaves(pixel.c);
    const double leave_y = y.leaves(pixel.r);
    if (clearance >= leap_from) {
      travelled += clearance - slack;
      if (travelled >= length) return true;
      const Pixel landed = OccupancyMap::pixel_of(from + direction * (travelled / length));
      const auto [low_c, high_c] = std::minmax(pixel.c, last.c);
      const auto [low_r, high_r] = std::minmax(pixel.r, last.r);
      pixel = {std::clamp(landed.c, low_c, high_c), std::clamp(landed.r, low_r, high_r)};
      continue;
    }
    travelled = std::max(travelled, std::min(leave_x, leave_y) * length);
    if (std::abs(leave_x - leave_y) * length <= corner_width) {
      if (clearance_.at({pixel.c + x.step, pixel.r}) <= 0.0F || clearance_.at({pixel.c, pixel.r + y.step}) <= 0.0F)
        return false;
      pixel = {pixel.c + x.step, pixel.r + y.step};
    } else if (leave_x < leave_y) {
      pixel.c += x.step;
    } else {
      pixel.r += y.step;
    }
  }
  return true;
}

}  // namespace lrrt
