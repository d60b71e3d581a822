// SPDX-License-Identifier: BSD-3-Clause
#include "ground.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "support.hpp"

namespace lrrt::property {
namespace {

using Eigen::Vector2d;

OccupancyMap bare_map(const PlanRequest& request) {
  const OccupancyMap& map = request.map.get();
  std::vector<Cell> cells = map.cells();
  for (Cell& cell : cells) {
    if (cell == Cell::unknown) cell = request.unknown == UnknownIs::free ? Cell::free : Cell::occupied;
  }
  return {map.width(), map.height(), std::move(cells)};
}

double to_box(const Vector2d& point, Pixel pixel) {
  const double dx = std::max({pixel.c - point.x(), 0.0, point.x() - pixel.c - 1.0});
  const double dy = std::max({pixel.r - point.y(), 0.0, point.y() - pixel.r - 1.0});
  return std::hypot(dx, dy);
}

double to_segment(const Vector2d& point, const Vector2d& from, const Vector2d& to) {
  const double length = (to - from).squaredNorm();
  const double t = length > 0.0 ? std::clamp((point - from).dot(to - from) / length, 0.0, 1.0) : 0.0;
  return (point - from - t * (to - from)).norm();
}

}  // namespace

Ground::Ground(const PlanRequest& request)
    : map_(request.map.get()),
      bare_(bare_map(request)),
      radius_(request.radius / request.map.get().resolution()),
      grown_(grow()),
      framed_(map_.with_cells(grown_.cells())) {}

Vector2d Ground::to_pixel(const Vector2d& world) const {
  if (!map_.is_metric()) return world;
  const std::complex<long double> offset(static_cast<long double>(world.x()) - map_.origin().x,
                                         static_cast<long double>(world.y()) - map_.origin().y);
  const std::complex<long double> turned = offset * std::polar(1.0L, -static_cast<long double>(map_.origin().yaw)) /
                                           static_cast<long double>(map_.resolution());
  return {static_cast<double>(turned.real()), static_cast<double>(map_.height() - turned.imag())};
}

OccupancyMap Ground::grow() const {
  if (radius_ == 0.0) return bare_;
  std::vector<Cell> cells = bare_.cells();
  const int reach = static_cast<int>(std::min(std::ceil(radius_) + 1.0, 1e6));
  const auto fits = [&](int c, int r) {
    for (int y = std::max(-1, r - reach); y <= std::min(bare_.height(), r + reach); ++y) {
      for (int x = std::max(-1, c - reach); x <= std::min(bare_.width(), c + reach); ++x) {
        if (bare_.is_free({x, y})) continue;
        if (std::hypot(std::max(0, std::abs(x - c) - 1), std::max(0, std::abs(y - r) - 1)) < radius_) return false;
      }
    }
    return true;
  };
  for (int r = 0; r < bare_.height(); ++r) {
    for (int c = 0; c < bare_.width(); ++c) {
      Cell& cell = cells[bare_.index({c, r})];
      if (cell == Cell::free && !fits(c, r)) cell = Cell::occupied;
    }
  }
  return bare_.with_cells(std::move(cells));
}

bool Ground::on_a_border(const Vector2d& pixel) const {
  if (!map_.is_metric()) return false;
  const auto near = [](double value) { return std::abs(value - std::round(value)) < 1e-8; };
  return near(pixel.x()) || near(pixel.y());
}

std::vector<Pixel> shortest_way(const OccupancyMap& map, Pixel from, Pixel to) {
  if (!map.is_free(from) || !map.is_free(to)) return {};
  std::vector<Pixel> parent(map.size(), {-1, -1});
  std::vector<Pixel> queue{to};
  parent[map.index(to)] = to;
  for (std::size_t i = 0; i < queue.size() && parent[map.index(from)].c < 0; ++i) {
    const Pixel at = queue[i];
    for (const Pixel next : {Pixel{at.c + 1, at.r}, {at.c - 1, at.r}, {at.c, at.r + 1}, {at.c, at.r - 1}}) {
      if (!map.is_free(next) || parent[map.index(next)].c >= 0) continue;
      parent[map.index(next)] = at;
      queue.push_back(next);
    }
  }
  if (parent[map.index(from)].c < 0) return {};
  std::vector<Pixel> way{from};
  while (way.back() != to) way.push_back(parent[map.index(way.back())]);
  return way;
}

double clearance(const OccupancyMap& map, const Vector2d& point, double most) {
  double least = std::min({point.x(), point.y(), map.width() - point.x(), map.height() - point.y()});
  const auto low = [&](double value) { return static_cast<int>(std::floor(std::max(0.0, value - most))) - 1; };
  const auto high = [&](double value, int side) { return static_cast<int>(std::min(side - 1.0, value + most + 1.0)); };
  for (int r = low(point.y()); r <= high(point.y(), map.height()); ++r) {
    for (int c = low(point.x()); c <= high(point.x(), map.width()); ++c) {
      if (!map.is_free({c, r})) least = std::min(least, to_box(point, {c, r}));
    }
  }
  return least;
}

double gap(const Vector2d& from, const Vector2d& to, Pixel pixel) {
  double least = std::min(to_box(from, pixel), to_box(to, pixel));
  for (int k = 0; k < 4; ++k) {
    least = std::min(least, to_segment({pixel.c + k % 2, pixel.r + k / 2}, from, to));
  }
  // a segment that crosses a box has both ends outside: then it passes between two of the corners
  const Vector2d way = to - from;
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (int k = 0; k < 4; ++k) {
    const Vector2d corner = Vector2d(pixel.c + k % 2, pixel.r + k / 2) - from;
    const double side = way.x() * corner.y() - way.y() * corner.x();
    lowest = std::min(lowest, side);
    highest = std::max(highest, side);
  }
  const bool beside = std::max(from.x(), to.x()) < pixel.c || std::min(from.x(), to.x()) > pixel.c + 1 ||
                      std::max(from.y(), to.y()) < pixel.r || std::min(from.y(), to.y()) > pixel.r + 1;
  return !beside && lowest < 0.0 && highest > 0.0 ? 0.0 : least;
}

}  // namespace lrrt::property
