// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/map/distance_field.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace lrrt {

DistanceField::DistanceField(const OccupancyMap& map)
    : width_(map.width()), height_(map.height()), distance_(map.size()) {
  // A frame of one blocked pixel stands for everything outside the map: none of it is nearer than the frame.
  cv::Mat1b framed(height_ + 2, width_ + 2, std::uint8_t{0});
  for (int r = 0; r < height_; ++r) {
    const Cell* source = map.cells().data() + map.index({0, r});
    std::transform(source, source + width_, framed.ptr(r + 1) + 1,
                   [](Cell cell) { return static_cast<std::uint8_t>(cell == Cell::free); });
  }
  cv::Mat1f distance;
  cv::distanceTransform(framed, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
  distance(cv::Rect(1, 1, width_, height_)).copyTo(cv::Mat1f(height_, width_, distance_.data()));
}

}  // namespace lrrt
