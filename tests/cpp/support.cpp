// SPDX-License-Identifier: BSD-3-Clause
#include "support.hpp"

#include <algorithm>
#include <string>

namespace lrrt::test {
namespace {

/// Length of the part of [0, 1] in which one coordinate of the segment lies strictly between low and high.
struct Interval {
  double from = 0.0;
  double to = 1.0;

  void clip(double start, double extent, double low, double high) {
    if (extent == 0.0) {
      if (start <= low || start >= high) to = -1.0;
      return;
    }
    const double a = (low - start) / extent;
    const double b = (high - start) / extent;
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
};

bool enters(Pixel p, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  Interval inside;
  inside.clip(from.x(), to.x() - from.x(), p.c, p.c + 1);
  inside.clip(from.y(), to.y() - from.y(), p.r, p.r + 1);
  return inside.to - inside.from > 1e-9;
}

}  // namespace

OccupancyMap map_from_rows(const std::vector<std::string>& rows) {
  std::vector<Cell> cells;
  for (const std::string& row : rows) {
    for (const char c : row) cells.push_back(c == '#' ? Cell::occupied : c == '?' ? Cell::unknown : Cell::free);
  }
  return {static_cast<int>(rows.front().size()), static_cast<int>(rows.size()), std::move(cells)};
}

OccupancyMap random_map(Random& random, int least_side, int most_side) {
  const auto side = [&] {
    return least_side + static_cast<int>(random.index(static_cast<std::size_t>(most_side - least_side + 1)));
  };
  const int width = side();
  const int height = side();
  std::vector<Cell> cells(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), Cell::free);
  const double wanted = random.uniform(0.0, 1.2) * static_cast<double>(cells.size());
  for (double covered = 0.0; covered < wanted;) {
    const int w = 1 + static_cast<int>(random.index(static_cast<std::size_t>(std::max(2, width / 4))));
    const int h = 1 + static_cast<int>(random.index(static_cast<std::size_t>(std::max(2, height / 4))));
    const int c0 = static_cast<int>(random.index(static_cast<std::size_t>(width)));
    const int r0 = static_cast<int>(random.index(static_cast<std::size_t>(height)));
    for (int r = r0; r < std::min(height, r0 + h); ++r) {
      for (int c = c0; c < std::min(width, c0 + w); ++c)
        cells[static_cast<std::size_t>(r * width + c)] = Cell::occupied;
    }
    covered += w * h;
  }
  cells.front() = Cell::free;
  return {width, height, std::move(cells)};
}

Eigen::Vector2d random_free_point(const OccupancyMap& map, Random& random) {
  for (;;) {
    const Eigen::Vector2d point(random.uniform(0, map.width()), random.uniform(0, map.height()));
    if (map.is_free(OccupancyMap::pixel_of(point))) return point;
  }
}

bool crosses_blocked(const OccupancyMap& map, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d low = from.cwiseMin(to);
  const Eigen::Vector2d high = from.cwiseMax(to);
  if (low.minCoeff() < 0.0 || high.x() > map.width() || high.y() > map.height()) return true;
  for (int r = static_cast<int>(low.y()); r <= static_cast<int>(high.y()); ++r) {
    for (int c = static_cast<int>(low.x()); c <= static_cast<int>(high.x()); ++c) {
      if (!map.is_free({c, r}) && enters({c, r}, from, to)) return true;
    }
  }
  return false;
}

std::vector<std::uint8_t> flood(const OccupancyMap& map, Pixel from) {
  std::vector<std::uint8_t> reached(map.size(), 0);
  std::vector<Pixel> open;
  const auto visit = [&](Pixel p) {
    if (!map.is_free(p) || reached[map.index(p)] != 0) return;
    reached[map.index(p)] = 1;
    open.push_back(p);
  };
  visit(from);
  while (!open.empty()) {
    const Pixel p = open.back();
    open.pop_back();
    visit({p.c + 1, p.r});
    visit({p.c - 1, p.r});
    visit({p.c, p.r + 1});
    visit({p.c, p.r - 1});
  }
  return reached;
}

}  // namespace lrrt::test
