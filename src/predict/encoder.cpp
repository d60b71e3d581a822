// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/predict/encoder.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>

#include "free_pixel.hpp"
#include "lrrt/error.hpp"
#include "lrrt/map/flood.hpp"

namespace lrrt {
namespace {

cv::Rect to_rect(const PixelBox& box) {
  return {box.c, box.r, box.width, box.height};
}

/// The box of the components of start and goal, one pixel wider where the map goes on.
PixelBox part_that_matters(const OccupancyMap& map, Pixel start, Pixel goal) {
  const std::vector<std::uint8_t> free = map.free_mask();
  const Flood around_start(free, map.width(), map.height(), start);
  PixelBox box = around_start.box();
  if (!around_start.reached(goal)) box = united(box, Flood(free, map.width(), map.height(), goal).box());
  return clipped(widened(box, 1.0), map.width(), map.height());
}

InputFit fit(const OccupancyMap& map, int size, const PixelBox& crop) {
  const int extent = std::max(crop.width, crop.height);
  InputFit result;
  result.map_width = map.width();
  result.map_height = map.height();
  result.size = size;
  result.crop = crop;
  const int whole = size / extent;
  result.scale = whole >= 1 ? whole : static_cast<double>(size) / extent;
  const auto scaled = [&](int side) { return std::max(1, static_cast<int>(std::lround(side * result.scale))); };
  result.placed.width = scaled(crop.width);
  result.placed.height = scaled(crop.height);
  result.placed.c = (size - result.placed.width) / 2;
  result.placed.r = (size - result.placed.height) / 2;
  return result;
}

/// A part of the map: 255 free, 0 not.
cv::Mat1b free_pixels(const OccupancyMap& map, const PixelBox& crop) {
  cv::Mat1b part(crop.height, crop.width);
  for (int r = 0; r < part.rows; ++r) {
    const Cell* source = map.cells().data() + map.index({crop.c, crop.r + r});
    std::transform(source, source + part.cols, part.ptr(r),
                   [](Cell cell) { return static_cast<std::uint8_t>(cell == Cell::free ? 255 : 0); });
  }
  return part;
}

/// One plane with the brightness of the map: 255 free, 0 occupied, grey where pixels were averaged.
cv::Mat1b brightness(const cv::Mat1b& part, const InputFit& fit) {
  cv::Mat1b plane(fit.size, fit.size, std::uint8_t{0});
  cv::Mat1b place = plane(to_rect(fit.placed));
  cv::resize(part, place, place.size(), 0, 0, fit.scale < 1.0 ? cv::INTER_AREA : cv::INTER_NEAREST);
  return plane;
}

/// True when no row has a run of free pixels shorter than this.
bool rows_are_wide(const cv::Mat1b& part, int length) {
  for (int r = 0; r < part.rows; ++r) {
    const std::uint8_t* row = part.ptr(r);
    int run = 0;
    for (int c = 0; c < part.cols; ++c) {
      if (row[c] != 0) {
        ++run;
      } else {
        if (run > 0 && run < length) return false;
        run = 0;
      }
    }
    if (run > 0 && run < length) return false;
  }
  return true;
}

/// True when every free pixel lies in a free square of so many pixels a side.
bool passages_are_wide(const cv::Mat1b& part, int side) {
  if (!rows_are_wide(part, side)) return false;  // soon said, where there is a narrow passage
  const cv::Mat square = cv::getStructuringElement(cv::MORPH_RECT, {side, side});
  cv::Mat1b opened;
  cv::erode(part, opened, square, {0, 0}, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::dilate(opened, opened, square, {side - 1, side - 1}, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  return cv::countNonZero(part) == cv::countNonZero(opened);
}

/// On maps that are shown at less than half their size, looking for narrow passages takes longer than it saves.
constexpr double least_scale = 0.5;

/// The smallest input in which passages keep their width, else the largest.
InputFit smallest_fit(const OccupancyMap& map, const InputSpec& spec, const PixelBox& crop, const cv::Mat1b& part) {
  InputFit largest = fit(map, spec.size, crop);
  if (largest.scale < least_scale) return largest;
  for (const int side : spec.smaller) {
    const InputFit smaller = fit(map, side, crop);
    const auto width = static_cast<int>(std::ceil(spec.least_passage / smaller.scale - 1e-9));  // map pixels
    if (passages_are_wide(part, width)) return smaller;
  }
  return largest;
}

/// Blends free and obstacle colour by brightness into one colour plane.
void paint(const cv::Mat1b& bright, std::uint8_t obstacle, std::uint8_t free, cv::Mat1b plane) {
  if (obstacle == 0 && free == 255) {
    bright.copyTo(plane);
    return;
  }
  bright.convertTo(plane, CV_8U, (free - obstacle) / 255.0, obstacle);
}

cv::Rect marker(const InputFit& fit, Pixel pixel, int least_side) {
  const int side = std::max(least_side, static_cast<int>(std::ceil(fit.scale)));
  const double x = fit.placed.c + (pixel.c - fit.crop.c + 0.5) * fit.scale_x();
  const double y = fit.placed.r + (pixel.r - fit.crop.r + 0.5) * fit.scale_y();
  const cv::Rect square(static_cast<int>(std::lround(x - side / 2.0)), static_cast<int>(std::lround(y - side / 2.0)),
                        side, side);
  return square & cv::Rect(0, 0, fit.size, fit.size);
}

}  // namespace

std::vector<std::uint8_t> InputFit::to_input(const std::vector<std::uint8_t>& values, std::uint8_t fill) const {
  const auto width = static_cast<std::size_t>(map_width);
  if (values.size() != width * static_cast<std::size_t>(map_height)) {
    throw RequestError("to_input takes one value per pixel of the map, " + std::to_string(map_width) + "×" +
                       std::to_string(map_height) + ", but " + std::to_string(values.size()) + " were given");
  }
  std::vector<std::uint8_t> result(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), fill);
  const auto source = [](int i, double scale, int side) {
    return std::min(side - 1, static_cast<int>((i + 0.5) / scale));
  };
  std::vector<int> columns(static_cast<std::size_t>(placed.width));
  for (int i = 0; i < placed.width; ++i) {
    columns[static_cast<std::size_t>(i)] = crop.c + source(i, scale_x(), crop.width);
  }
  for (int j = 0; j < placed.height; ++j) {
    const std::size_t row = static_cast<std::size_t>(crop.r + source(j, scale_y(), crop.height)) * width;
    auto* target = result.data() + static_cast<std::size_t>(placed.r + j) * static_cast<std::size_t>(size) + placed.c;
    for (const int column : columns) *target++ = values[row + static_cast<std::size_t>(column)];
  }
  return result;
}

std::vector<float> InputFit::to_map(const float* plane) const {
  std::vector<float> result(static_cast<std::size_t>(map_width) * static_cast<std::size_t>(map_height), 0.0F);
  const cv::Mat1f input(size, size, const_cast<float*>(plane));
  cv::Mat1f place = cv::Mat1f(map_height, map_width, result.data())(to_rect(crop));
  cv::resize(input(to_rect(placed)), place, place.size(), 0, 0, scale < 1.0 ? cv::INTER_LINEAR : cv::INTER_AREA);
  return result;
}

Encoder::Encoder(InputSpec spec) : spec_(std::move(spec)) {
  std::vector<int> sides = spec_.smaller;
  sides.push_back(spec_.size);
  for (const int side : sides) {
    if (side >= 8 && side <= 8192) continue;
    throw RequestError("network input of " + std::to_string(side) + " pixels: expected a side from 8 to 8192");
  }
  if (std::adjacent_find(sides.begin(), sides.end(), std::greater_equal<>()) != sides.end()) {
    throw RequestError("smaller network inputs: expected ascending sides below " + std::to_string(spec_.size));
  }
  if (spec_.marker_side < 1 || spec_.marker_side > sides.front()) {
    throw RequestError("marker side of " + std::to_string(spec_.marker_side) +
                       " pixels: expected 1 to the input's side, " + std::to_string(sides.front()));
  }
  if (!(spec_.least_passage >= 1.0 && spec_.least_passage <= spec_.size)) {
    throw RequestError("least passage of " + std::to_string(spec_.least_passage) +
                       " pixels: expected 1 to the input's side, " + std::to_string(spec_.size));
  }
}

InputFit Encoder::encode(const OccupancyMap& map, const Eigen::Vector2d& start, const Eigen::Vector2d& goal,
                         std::vector<std::uint8_t>& image) const {
  return encode(map, start, goal, [&](int side) {
    image.resize(3 * static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    return image.data();
  });
}

InputFit Encoder::encode(const OccupancyMap& map, const Eigen::Vector2d& start, const Eigen::Vector2d& goal,
                         const std::function<std::uint8_t*(int side)>& place) const {
  const Pixel start_pixel = free_pixel(map, start, "start");
  const Pixel goal_pixel = free_pixel(map, goal, "goal");
  const PixelBox crop = part_that_matters(map, start_pixel, goal_pixel);
  const cv::Mat1b part = free_pixels(map, crop);
  const InputFit result = smallest_fit(map, spec_, crop, part);
  const cv::Mat1b bright = brightness(part, result);
  const cv::Rect start_marker = marker(result, start_pixel, spec_.marker_side);
  const cv::Rect goal_marker = marker(result, goal_pixel, spec_.marker_side);
  const auto plane_size = static_cast<std::size_t>(result.size) * static_cast<std::size_t>(result.size);
  std::uint8_t* image = place(result.size);
  for (std::size_t k = 0; k < 3; ++k) {
    cv::Mat1b plane(result.size, result.size, image + k * plane_size);
    paint(bright, spec_.colours.obstacle[k], spec_.colours.free[k], plane);
    plane(start_marker) = spec_.colours.start[k];
    plane(goal_marker) = spec_.colours.goal[k];
  }
  return result;
}

}  // namespace lrrt
