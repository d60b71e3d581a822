// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/map/occupancy_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

#include "lrrt/error.hpp"

namespace lrrt {
namespace {

void check_size(int width, int height, std::size_t cells) {
  if (width <= 0 || height <= 0) {
    throw MapError("map size " + std::to_string(width) + "×" + std::to_string(height) +
                   " is empty: both sides must be at least 1 pixel");
  }
  if (std::int64_t{width} > max_map_pixels / height) {
    throw MapError("a map of " + std::to_string(width) + "×" + std::to_string(height) +
                   " pixels is too large: at most " + std::to_string(max_map_pixels) +
                   " pixels in all; use a coarser map or crop it");
  }
  const auto expected = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (cells != expected) {
    throw MapError("a map of " + std::to_string(width) + "×" + std::to_string(height) + " pixels needs " +
                   std::to_string(expected) + " cells, but " + std::to_string(cells) + " were given");
  }
}

void check_frame(double resolution, const Pose2& origin) {
  // Beyond these bounds pixels cannot be told apart any more in double precision, or OMPL's distances overflow.
  constexpr double finest = 1e-6;
  constexpr double coarsest = 1e6;
  constexpr double farthest = 1e9;
  if (!(resolution >= finest && resolution <= coarsest)) {
    std::ostringstream text;
    text << "map resolution " << resolution << ": expected metres per pixel, from " << finest << " to " << coarsest;
    throw MapError(text.str());
  }
  if (!(std::abs(origin.x) <= farthest && std::abs(origin.y) <= farthest && std::isfinite(origin.yaw))) {
    throw MapError("map origin [" + std::to_string(origin.x) + ", " + std::to_string(origin.y) + ", " +
                   std::to_string(origin.yaw) + "]: expected finite numbers, at most 1e9 metres from zero");
  }
}

int floor_to_int(double value) {
  constexpr double low = std::numeric_limits<int>::min();
  constexpr double high = std::numeric_limits<int>::max();
  if (std::isnan(value)) return std::numeric_limits<int>::min();
  return static_cast<int>(std::clamp(std::floor(value), low, high));
}

}  // namespace

OccupancyMap::OccupancyMap(int width, int height, std::vector<Cell> cells)
    : OccupancyMap(width, height, std::move(cells), 1.0, Pose2{}, false) {}

OccupancyMap::OccupancyMap(int width, int height, std::vector<Cell> cells, double resolution, Pose2 origin)
    : OccupancyMap(width, height, std::move(cells), resolution, origin, true) {}

OccupancyMap::OccupancyMap(int width, int height, std::vector<Cell> cells, double resolution, Pose2 origin, bool metric)
    : width_(width),
      height_(height),
      cells_(std::move(cells)),
      resolution_(resolution),
      origin_(origin),
      metric_(metric),
      cos_yaw_(std::cos(origin.yaw)),
      sin_yaw_(std::sin(origin.yaw)) {
  check_size(width_, height_, cells_.size());
  check_frame(resolution_, origin_);
}

Pixel OccupancyMap::pixel_of(const Eigen::Vector2d& point) {
  return {floor_to_int(point.x()), floor_to_int(point.y())};
}

Eigen::Vector2d OccupancyMap::to_pixel(const Eigen::Vector2d& world) const {
  if (!metric_) return world;
  const double dx = world.x() - origin_.x;
  const double dy = world.y() - origin_.y;
  const double u = (cos_yaw_ * dx + sin_yaw_ * dy) / resolution_;
  const double v = (-sin_yaw_ * dx + cos_yaw_ * dy) / resolution_;
  return {u, height_ - v};
}

Eigen::Vector2d OccupancyMap::to_world(const Eigen::Vector2d& pixel) const {
  if (!metric_) return pixel;
  const double u = pixel.x() * resolution_;
  const double v = (height_ - pixel.y()) * resolution_;
  return {origin_.x + cos_yaw_ * u - sin_yaw_ * v, origin_.y + sin_yaw_ * u + cos_yaw_ * v};
}

std::vector<std::uint8_t> OccupancyMap::free_mask() const {
  std::vector<std::uint8_t> mask(cells_.size());
  std::transform(cells_.begin(), cells_.end(), mask.begin(),
                 [](Cell cell) { return static_cast<std::uint8_t>(cell == Cell::free); });
  return mask;
}

Bounds OccupancyMap::bounds() const {
  Bounds box;
  box.low = box.high = to_world({0.0, 0.0});
  for (const Eigen::Vector2d& corner :
       {Eigen::Vector2d(width_, 0.0), Eigen::Vector2d(0.0, height_), Eigen::Vector2d(width_, height_)}) {
    const Eigen::Vector2d world = to_world(corner);
    box.low = box.low.cwiseMin(world);
    box.high = box.high.cwiseMax(world);
  }
  return box;
}

OccupancyMap OccupancyMap::resolved(UnknownIs meaning) const {
  if (std::find(cells_.begin(), cells_.end(), Cell::unknown) == cells_.end()) return *this;
  std::vector<Cell> cells = cells_;
  std::replace(cells.begin(), cells.end(), Cell::unknown, meaning == UnknownIs::free ? Cell::free : Cell::occupied);
  return with_cells(std::move(cells));
}

OccupancyMap OccupancyMap::with_cells(std::vector<Cell> cells) const {
  return OccupancyMap(width_, height_, std::move(cells), resolution_, origin_, metric_);
}

}  // namespace lrrt
