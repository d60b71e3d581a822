// SPDX-License-Identifier: BSD-3-Clause
#include "distance_transform.hpp"

#include <algorithm>

namespace lrrt {
namespace {

std::size_t at(int column, int row, int width) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
}

/// Distance to the nearest blocked pixel of the same column, row after row down and up again.
std::vector<std::int32_t> column_distances(const std::vector<std::uint8_t>& open, int width, int height) {
  std::vector<std::int32_t> distance(open.size());
  for (int r = 0; r < height; ++r) {
    for (int c = 0; c < width; ++c) {
      const std::size_t i = at(c, r, width);
      distance[i] = open[i] == 0 ? 0 : (r == 0 ? 1 : distance[i - static_cast<std::size_t>(width)] + 1);
    }
  }
  for (int r = height - 1; r >= 0; --r) {
    for (int c = 0; c < width; ++c) {
      const std::size_t i = at(c, r, width);
      const std::int32_t below = r == height - 1 ? 0 : distance[i + static_cast<std::size_t>(width)];
      distance[i] = std::min(distance[i], below + 1);
    }
  }
  return distance;
}

/// The lower envelope of the parabolas that the columns of one row stand for; the columns beside the picture are
/// blocked.
class Envelope {
 public:
  explicit Envelope(int width) : width_(width), column_(static_cast<std::size_t>(width) + 2), begin_(column_.size()) {}

  void run(const std::int32_t* column_distance, std::int64_t* squared) {
    const auto height = [&](std::int64_t u) -> std::int64_t {
      if (u < 0 || u >= width_) return 0;
      return std::int64_t{column_distance[u]} * column_distance[u];
    };
    const auto value = [&](std::int64_t x, std::int64_t u) { return (x - u) * (x - u) + height(u); };
    std::size_t top = 0;
    column_[0] = -1;
    begin_[0] = -1;
    for (std::int64_t u = 0; u <= width_; ++u) {
      while (value(begin_[top], column_[top]) > value(begin_[top], u)) {
        if (top == 0) break;
        --top;
      }
      // the first x at which the parabola of u is not above the last one's
      const std::int64_t left = column_[top];
      const std::int64_t from = 1 + floor_ratio(u * u - left * left + height(u) - height(left), 2 * (u - left));
      if (from > width_) continue;
      ++top;
      column_[top] = u;
      begin_[top] = from;
    }
    for (std::int64_t x = width_; x >= 0; --x) {
      while (begin_[top] > x) --top;
      if (x < width_) squared[x] = value(x, column_[top]);
    }
  }

 private:
  /// Quotient rounded towards minus infinity; the divisor is positive.
  static std::int64_t floor_ratio(std::int64_t dividend, std::int64_t divisor) {
    const std::int64_t quotient = dividend / divisor;
    return dividend % divisor < 0 ? quotient - 1 : quotient;
  }

  std::int64_t width_;
  std::vector<std::int64_t> column_;
  std::vector<std::int64_t> begin_;
};

}  // namespace

std::vector<std::int64_t> squared_distances(const std::vector<std::uint8_t>& open, int width, int height) {
  const std::vector<std::int32_t> column_distance = column_distances(open, width, height);
  std::vector<std::int64_t> squared(open.size());
  Envelope envelope(width);
  for (int r = 0; r < height; ++r)
    envelope.run(column_distance.data() + at(0, r, width), squared.data() + at(0, r, width));
  return squared;
}

}  // namespace lrrt
