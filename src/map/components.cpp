// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/map/components.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace lrrt {
Components::Components(const OccupancyMap& map) : Components(map.width(), map.height(), map.free_mask()) {}

Components::Components(int width, int height, const std::vector<std::uint8_t>& mask)
    : width_(width), height_(height), labels_(mask.size()) {
  const cv::Mat source(height, width, CV_8UC1, const_cast<std::uint8_t*>(mask.data()));
  cv::Mat labels(height, width, CV_32SC1, labels_.data());
  cv::Mat stats;
  cv::Mat centroids;
  const int count = cv::connectedComponentsWithStats(source, labels, stats, centroids, 4, CV_32S);
  for (int i = 0; i < count; ++i) {
    boxes_.push_back({stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                      stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT)});
    areas_.push_back(stats.at<int>(i, cv::CC_STAT_AREA));
  }
}

int Components::label(Pixel p) const {
  if (p.c < 0 || p.r < 0 || p.c >= width_ || p.r >= height_) return 0;
  return labels_[static_cast<std::size_t>(p.r) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(p.c)];
}

bool Components::joined(Pixel a, Pixel b) const {
  const int component = label(a);
  return component != 0 && component == label(b);
}

}  // namespace lrrt
