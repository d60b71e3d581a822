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
  const std::vector<std::int32_t> outside(static_cast<std::size_t>(width), 0);
  const auto row_of = [&](int r) { return r < 0 || r >= height ? outside.data() : distance.data() + at(0, r, width); };
  for (int r = 0; r < height; ++r) {
    const std::uint8_t* inside = open.data() + at(0, r, width);
    const std::int32_t* above = row_of(r - 1);
    std::int32_t* row = distance.data() + at(0, r, width);
    for (int c = 0; c < width; ++c) row[c] = inside[c] == 0 ? 0 : above[c] + 1;
  }
  for (int r = height - 1; r >= 0; --r) {
    const std::int32_t* below = row_of(r + 1);
    std::int32_t* row = distance.data() + at(0, r, width);
    for (int c = 0; c < width; ++c) row[c] = std::min(row[c], below[c] + 1);
  }
  return distance;
}

/// The lower envelope of the parabolas that the columns of one row stand for; the columns beside the picture are
/// blocked.
class Envelope {
 public:
  explicit Envelope(int width) : width_(width), column_(static_cast<std::size_t>(width) + 2), begin_(column_.size()) {}

  void run(const std::int32_t* column_distance, std::int32_t* squared) {
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
      if (x < width_) squared[x] = static_cast<std::int32_t>(value(x, column_[top]));
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

/// Steps that looking around may take, for each pixel of a row: rows of mazes and buildings take fewer, and beyond it
/// an envelope is quicker.
constexpr std::int64_t most_steps = 4;
/// Where a row took more, its neighbours will: so many go to the envelope at once.
constexpr int rows_alike = 16;

/// One row, by looking left and right of every pixel until nothing nearer can come; the pixels beside the row are
/// blocked. @return false when that takes too many steps; the row is not complete then.
bool look_around(const std::int32_t* column_distance, int width, std::int32_t* squared) {
  std::int64_t steps = most_steps * width;
  for (int x = 0; x < width; ++x) {
    std::int64_t best = std::int64_t{column_distance[x]} * column_distance[x];
    std::int64_t k = 1;
    for (; k * k < best; ++k) {
      const std::int64_t left = x < k ? 0 : column_distance[x - k];
      const std::int64_t right = x + k >= width ? 0 : column_distance[x + k];
      const std::int64_t nearer = std::min(left, right);
      best = std::min(best, k * k + nearer * nearer);
    }
    squared[x] = static_cast<std::int32_t>(best);
    steps -= k;
    if (steps < 0) return false;
  }
  return true;
}

}  // namespace

std::vector<std::int32_t> squared_distances(const std::vector<std::uint8_t>& open, int width, int height) {
  const std::vector<std::int32_t> column_distance = column_distances(open, width, height);
  std::vector<std::int32_t> squared(open.size());
  Envelope envelope(width);
  int open_until = 0;
  for (int r = 0; r < height; ++r) {
    const std::int32_t* row = column_distance.data() + at(0, r, width);
    std::int32_t* result = squared.data() + at(0, r, width);
    if (r >= open_until && look_around(row, width, result)) continue;
    if (r >= open_until) open_until = r + 1 + rows_alike;
    envelope.run(row, result);
  }
  return squared;
}

}  // namespace lrrt
