// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/map/footprint.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>

#include "lrrt/error.hpp"

namespace lrrt {

OccupancyMap inflated(const OccupancyMap& map, double radius) {
  if (!std::isfinite(radius) || radius < 0.0) {
    throw RequestError("robot radius " + std::to_string(radius) + " must be zero or a positive number of map units");
  }
  if (radius == 0.0) return map;
  const int width = map.width();
  const int height = map.height();
  // The gap between two pixel squares is the distance between the centre of one and the centres of the 3×3 block around
  // the other, so one dilation turns the centre-to-centre transform into the square-to-square distance that is needed.
  cv::Mat1b free(height + 2, width + 2, std::uint8_t{0});
  for (int r = 0; r < height; ++r) {
    for (int c = 0; c < width; ++c) free(r + 1, c + 1) = static_cast<std::uint8_t>(map.at({c, r}) == Cell::free);
  }
  cv::Mat1b shrunk;
  cv::erode(free, shrunk, cv::Mat::ones(3, 3, CV_8U), cv::Point(-1, -1), 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::Mat1f gap;
  cv::distanceTransform(shrunk, gap, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
  std::vector<Cell> cells = map.cells();
  const double pixels = radius / map.resolution();
  for (int r = 0; r < height; ++r) {
    for (int c = 0; c < width; ++c) {
      if (free(r + 1, c + 1) != 0 && gap(r + 1, c + 1) < pixels) cells[map.index({c, r})] = Cell::occupied;
    }
  }
  return map.with_cells(std::move(cells));
}

}  // namespace lrrt
