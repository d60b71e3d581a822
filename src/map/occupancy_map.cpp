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
  if (!(resolution >= finest_resolution && resolution <= coarsest_resolution)) {
    std::ostringstream text;
    text << "map resolution " << resolution << ": expected metres per pixel, from " << finest_resolution << " to "
         << coarsest_resolution;
    throw MapError(text.str());
  }
  if (!(std::abs(origin.x) <= farthest_origin && std::abs(origin.y) <= farthest_origin && std::isfinite(origin.yaw))) {
    throw MapError("map origin [" + std::to_string(origin.x) + ", " + std::to_string(origin.y) + ", " +
                   std::to_string(origin.yaw) + "]: expected finite numbers, at most 1e9 metres from zero");
  }
}

/// Which kinds of cells a part of a map has: a set of bits, one for each kind but free.
constexpr auto has_occupied = static_cast<std::uint8_t>(Cell::occupied);
constexpr auto has_unknown = static_cast<std::uint8_t>(Cell::unknown);
static_assert(static_cast<std::uint8_t>(Cell::free) == 0 && (has_occupied & has_unknown) == 0);

/// The kinds of cells in every column of so many rows. Outside the map all is occupied.
void look_at_rows(const OccupancyMap& map, int first, int rows, std::vector<std::uint8_t>& seen) {
  const auto width = static_cast<std::size_t>(map.width());
  const bool whole = first + rows <= map.height();
  std::fill(seen.begin(), seen.begin() + map.width(), whole ? std::uint8_t{0} : has_occupied);
  std::fill(seen.begin() + map.width(), seen.end(), has_occupied);
  for (int r = first; whole && r < first + rows; ++r) {
    const Cell* row = map.cells().data() + map.index({0, r});
    for (std::size_t c = 0; c < width; ++c)
      seen[c] = static_cast<std::uint8_t>(seen[c] | static_cast<unsigned>(row[c]));
  }
}

/// Appends one cell for every block of so many columns.
void append_blocks(const std::vector<std::uint8_t>& seen, std::size_t columns, std::vector<Cell>& cells) {
  for (std::size_t first = 0; first < seen.size(); first += columns) {
    unsigned kinds = 0;
    for (std::size_t c = first; c < first + columns; ++c) kinds |= seen[c];
    cells.push_back((kinds & has_occupied) != 0 ? Cell::occupied : kinds != 0 ? Cell::unknown : Cell::free);
  }
}

int floor_to_int(double value) {
  constexpr double low = std::numeric_limits<int>::min();
  constexpr double high = std::numeric_limits<int>::max();
  if (std::isnan(value)) return std::numeric_limits<int>::min();
  return static_cast<int>(std::clamp(std::floor(value), low, high));
}

}  // namespace

OccupancyMap::OccupancyMap(int width, int height, std::vector<Cell> cells, const Frame& frame)
    : width_(width), height_(height), cells_(std::move(cells)), frame_(frame) {
  check_size(width_, height_, cells_.size());
}

OccupancyMap::OccupancyMap(int width, int height, std::vector<Cell> cells)
    : OccupancyMap(width, height, std::move(cells), Frame{}) {}

OccupancyMap::OccupancyMap(int width, int height, std::vector<Cell> cells, double resolution, Pose2 origin)
    : OccupancyMap(width, height, std::move(cells), Frame{}) {
  check_frame(resolution, origin);
  frame_.metric = true;
  frame_.resolution = resolution;
  frame_.origin = origin;
  frame_.cos_yaw = std::cos(origin.yaw);
  frame_.sin_yaw = std::sin(origin.yaw);
  frame_.height = height;
}

Pixel OccupancyMap::pixel_of(const Eigen::Vector2d& point) {
  return {floor_to_int(point.x()), floor_to_int(point.y())};
}

Eigen::Vector2d OccupancyMap::to_pixel(const Eigen::Vector2d& world) const {
  Eigen::Vector2d pixel = world;
  if (frame_.metric) {
    const double dx = world.x() - frame_.origin.x;
    const double dy = world.y() - frame_.origin.y;
    const double u = (frame_.cos_yaw * dx + frame_.sin_yaw * dy) / frame_.resolution;
    const double v = (-frame_.sin_yaw * dx + frame_.cos_yaw * dy) / frame_.resolution;
    pixel = {u, frame_.height - v};
  }
  return (pixel - frame_.corner) / frame_.coarseness;
}

Eigen::Vector2d OccupancyMap::to_world(const Eigen::Vector2d& pixel) const {
  Eigen::Vector2d original = pixel * frame_.coarseness + frame_.corner;
  if (!frame_.metric) return original;
  const double u = original.x() * frame_.resolution;
  const double v = (frame_.height - original.y()) * frame_.resolution;
  return {frame_.origin.x + frame_.cos_yaw * u - frame_.sin_yaw * v,
          frame_.origin.y + frame_.sin_yaw * u + frame_.cos_yaw * v};
}

Pose2 OccupancyMap::origin() const {
  const Eigen::Vector2d corner = to_world({0.0, static_cast<double>(height_)});
  return frame_.metric ? Pose2{corner.x(), corner.y(), frame_.origin.yaw} : Pose2{};
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
  return OccupancyMap(width_, height_, std::move(cells), frame_);
}

OccupancyMap OccupancyMap::cropped(const PixelBox& box) const {
  const bool inside = box.c >= 0 && box.r >= 0 && box.width > 0 && box.height > 0 && box.width <= width_ - box.c &&
                      box.height <= height_ - box.r;
  if (!inside) {
    throw MapError("crop of " + std::to_string(box.width) + "×" + std::to_string(box.height) + " pixels at column " +
                   std::to_string(box.c) + ", row " + std::to_string(box.r) + ": expected a box inside the map of " +
                   std::to_string(width_) + "×" + std::to_string(height_) + " pixels");
  }
  std::vector<Cell> cells;
  cells.reserve(static_cast<std::size_t>(box.width) * static_cast<std::size_t>(box.height));
  for (int r = box.r; r < box.r + box.height; ++r) {
    const Cell* row = cells_.data() + index({box.c, r});
    cells.insert(cells.end(), row, row + box.width);
  }
  Frame frame = frame_;
  frame.corner += Eigen::Vector2d(box.c, box.r) * frame.coarseness;
  return OccupancyMap(box.width, box.height, std::move(cells), frame);
}

int OccupancyMap::coarsening_to(int most_side) const {
  const int last = std::max(width_, height_) - 1;
  int factor = 1;
  while (last / factor >= std::max(1, most_side)) factor *= 2;
  return factor;
}

OccupancyMap OccupancyMap::coarsened(int factor) const {
  constexpr int most = 1 << 14;
  if (factor < 1 || factor > most || (factor & (factor - 1)) != 0) {
    throw MapError("coarsening by " + std::to_string(factor) + ": expected a power of two from 1 to " +
                   std::to_string(most));
  }
  if (factor == 1) return *this;
  const auto blocks = [factor](int side) { return 1 + (side - 1) / factor; };
  const int width = blocks(width_);
  const int height = blocks(height_);
  std::vector<Cell> cells;
  cells.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::vector<std::uint8_t> seen(static_cast<std::size_t>(width) * static_cast<std::size_t>(factor));
  for (int r = 0; r < height; ++r) {
    look_at_rows(*this, r * factor, factor, seen);
    append_blocks(seen, static_cast<std::size_t>(factor), cells);
  }
  Frame frame = frame_;
  frame.coarseness *= factor;
  return OccupancyMap(width, height, std::move(cells), frame);
}

}  // namespace lrrt
