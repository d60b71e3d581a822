// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/datastructures/NearestNeighbors.h>
#include <ompl/util/Exception.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace lrrt {

/// Nearest neighbours of a planner's nodes in the plane: a grid of cells about as large as one step of the planner,
/// each with the nodes in it. A query looks at the cells around it and computes distances itself, where OMPL's trees of
/// pivots call back for each of them. Answers are those of OMPL's structures, to the last bit of a distance. Queries
/// use a buffer of the structure, so they may not run side by side.
///
/// Motion is a pointer to something with a `state` of RealVectorStateSpace(2).
template <typename Motion>
class GridNeighbors final : public ompl::NearestNeighbors<Motion> {
 public:
  /// @param bounds of the space; nodes outside are kept in the cells at its edge. @param step side of a cell, within
  /// the least and the most cells that a grid may have.
  GridNeighbors(const ompl::base::RealVectorBounds& bounds, double step) : low_{bounds.low[0], bounds.low[1]} {
    const double width = bounds.high[0] - bounds.low[0];
    const double height = bounds.high[1] - bounds.low[1];
    const double coarsest = std::max(width, height) / least_cells;
    side_ = std::max(
        {std::min(step, coarsest), width / most_cells, height / most_cells, std::numeric_limits<double>::min()});
    columns_ = static_cast<int>(width / side_) + 1;
    rows_ = static_cast<int>(height / side_) + 1;
    cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  }

  /// What OMPL asks, see ompl::NearestNeighbors.
  /// @{
  void clear() override {
    for (std::vector<Node>& cell : cells_) cell.clear();
    size_ = 0;
  }
  bool reportsSortedResults() const override { return true; }
  std::size_t size() const override { return size_; }

  void add(const Motion& motion) override {
    const Point at = position(motion);
    cell(column(at.x), row(at.y)).push_back({at, motion});
    ++size_;
  }
  void add(const std::vector<Motion>& motions) override {
    for (const Motion& motion : motions) add(motion);
  }

  bool remove(const Motion& motion) override {
    const Point at = position(motion);
    std::vector<Node>& nodes = cell(column(at.x), row(at.y));
    const auto found = std::find_if(nodes.begin(), nodes.end(), [&](const Node& n) { return n.motion == motion; });
    if (found == nodes.end()) return false;
    nodes.erase(found);
    --size_;
    return true;
  }

  Motion nearest(const Motion& motion) const override {
    if (size_ == 0) throw ompl::Exception("No elements found in nearest neighbors data structure");
    const Point at = position(motion);
    const Node* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (int ring = 0; ring == 0 || least > reach(at, ring); ++ring) {
      visit_ring(at, ring, [&](const Node& node) {
        const double squared = squared_distance(node.at, at);
        if (squared >= least * least) return;
        least = std::sqrt(squared);
        best = &node;
      });
    }
    return best->motion;
  }

  void nearestK(const Motion& motion, std::size_t count, std::vector<Motion>& found) const override {
    const Point at = position(motion);
    std::vector<Near> near;
    const std::size_t wanted = std::min(count, size_);
    for (int ring = 0; near.size() < wanted || !complete(near, wanted, reach(at, ring)); ++ring) {
      visit_ring(at, ring, [&](const Node& node) { near.emplace_back(squared_distance(node.at, at), node.motion); });
    }
    take(near, wanted, found);
  }

  void nearestR(const Motion& motion, double radius, std::vector<Motion>& found) const override {
    const Point at = position(motion);
    std::vector<Near>& near = scratch_;
    near.clear();
    const int last_row = row(at.y + radius);
    const int last_column = column(at.x + radius);
    for (int r = row(at.y - radius); r <= last_row; ++r) {
      for (int c = column(at.x - radius); c <= last_column; ++c) {
        for (const Node& node : cell(c, r)) {
          const double squared = squared_distance(node.at, at);
          if (std::sqrt(squared) <= radius) near.emplace_back(squared, node.motion);
        }
      }
    }
    take(near, near.size(), found);
  }

  void list(std::vector<Motion>& all) const override {
    all.clear();
    all.reserve(size_);
    for (const std::vector<Node>& nodes : cells_) {
      for (const Node& node : nodes) all.push_back(node.motion);
    }
  }
  /// @}

 private:
  static constexpr double most_cells = 64.0;  ///< along the longer side
  static constexpr double least_cells = 16.0;

  struct Point {
    double x;
    double y;
  };
  struct Node {
    Point at;
    Motion motion;
  };
  using Near = std::pair<double, Motion>;  ///< squared distance, node

  static Point position(const Motion& motion) {
    const auto* values = motion->state->template as<ompl::base::RealVectorStateSpace::StateType>()->values;
    return {values[0], values[1]};
  }
  static double squared_distance(Point a, Point b) { return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y); }
  static int clamped(double cell, int count) {
    return static_cast<int>(std::clamp(std::floor(cell), 0.0, static_cast<double>(count - 1)));
  }
  int column(double x) const { return clamped((x - low_.x) / side_, columns_); }
  int row(double y) const { return clamped((y - low_.y) / side_, rows_); }
  std::size_t index(int c, int r) const {
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c);
  }
  std::vector<Node>& cell(int c, int r) { return cells_[index(c, r)]; }
  const std::vector<Node>& cell(int c, int r) const { return cells_[index(c, r)]; }

  /// Every node within this distance of a point lies in the rings before `ring`; infinite when those are all cells.
  double reach(Point at, int ring) const {
    const int c = column(at.x);
    const int r = row(at.y);
    if (ring > std::max({c, columns_ - 1 - c, r, rows_ - 1 - r})) return std::numeric_limits<double>::infinity();
    const double x = at.x - (low_.x + c * side_);
    const double y = at.y - (low_.y + r * side_);
    return (ring - 1) * side_ + std::max(0.0, std::min({x, y, side_ - x, side_ - y}));
  }

  /// Calls visit for the nodes of the cells at a distance of `ring` cells.
  template <typename Visit>
  void visit_ring(Point at, int ring, const Visit& visit) const {
    const int c0 = column(at.x);
    const int r0 = row(at.y);
    for (int r = std::max(0, r0 - ring); r <= std::min(rows_ - 1, r0 + ring); ++r) {
      const bool edge = r == r0 - ring || r == r0 + ring;
      const int stride = edge || ring == 0 ? 1 : 2 * ring;
      for (int c = c0 - ring; c <= c0 + ring; c += stride) {
        if (c < 0 || c >= columns_) continue;
        for (const Node& node : cell(c, r)) visit(node);
      }
    }
  }

  /// True when the nearest `wanted` of those found lie within a distance.
  static bool complete(std::vector<Near>& near, std::size_t wanted, double distance) {
    if (wanted == 0) return true;
    const auto last = near.begin() + static_cast<std::ptrdiff_t>(wanted - 1);
    std::nth_element(near.begin(), last, near.end());
    return last->first <= distance * distance;
  }

  static void take(std::vector<Near>& near, std::size_t count, std::vector<Motion>& found) {
    const auto by_distance = [](const Near& a, const Near& b) { return a.first < b.first; };
    std::stable_sort(near.begin(), near.end(), by_distance);
    found.clear();
    for (std::size_t i = 0; i < count; ++i) found.push_back(near[i].second);
  }

  Point low_;
  double side_ = 1.0;
  int columns_ = 1;
  int rows_ = 1;
  std::size_t size_ = 0;
  std::vector<std::vector<Node>> cells_;
  mutable std::vector<Near> scratch_;
};

}  // namespace lrrt
