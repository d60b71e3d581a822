// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <ompl/datastructures/NearestNeighborsLinear.h>

#include <cmath>
#include <memory>
#include <set>
#include <vector>

#include "lrrt/ompl/grid_neighbors.hpp"
#include "lrrt/sampling/random.hpp"

namespace lrrt {
namespace {

namespace ob = ompl::base;

/// A node as OMPL's planners have them.
struct Node {
  ob::State* state = nullptr;
};

/// Nodes in a rectangle, in our structure and in OMPL's linear one.
class GridAndLinear {
 public:
  GridAndLinear(double width, double height, double step, std::uint64_t seed)
      : space_(std::make_shared<ob::RealVectorStateSpace>(2)), random_(seed), width_(width), height_(height) {
    ob::RealVectorBounds bounds(2);
    bounds.setLow(-3.0);
    bounds.setHigh(0, width - 3.0);
    bounds.setHigh(1, height - 3.0);
    grid_ = std::make_unique<GridNeighbors<Node*>>(bounds, step);
    grid_->setDistanceFunction([this](const Node* a, const Node* b) { return distance(a, b); });
    linear_.setDistanceFunction([this](const Node* a, const Node* b) { return distance(a, b); });
  }
  ~GridAndLinear() {
    for (const std::unique_ptr<Node>& node : nodes_) space_->freeState(node->state);
  }
  GridAndLinear(const GridAndLinear&) = delete;
  GridAndLinear& operator=(const GridAndLinear&) = delete;

  /// A node inside the rectangle or a little outside it; some on top of others.
  Node* make() {
    nodes_.push_back(std::make_unique<Node>());
    Node* node = nodes_.back().get();
    node->state = space_->allocState();
    double* values = node->state->as<ob::RealVectorStateSpace::StateType>()->values;
    values[0] = random_.uniform(-3.0 - 0.1 * width_, 1.1 * width_ - 3.0);
    values[1] = random_.uniform(-3.0 - 0.1 * height_, 1.1 * height_ - 3.0);
    if (random_.uniform() < 0.1) values[0] = std::round(values[0]);
    return node;
  }
  void add() {
    Node* node = make();
    in_.push_back(node);
    grid_->add(node);
    linear_.add(node);
  }
  void remove() {
    const std::size_t i = random_.index(in_.size());
    EXPECT_TRUE(grid_->remove(in_[i]));
    EXPECT_FALSE(grid_->remove(in_[i]));
    linear_.remove(in_[i]);
    in_.erase(in_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  double distance(const Node* a, const Node* b) const { return space_->distance(a->state, b->state); }

  void compare(std::size_t count, double radius) {
    const Node* query = make();
    EXPECT_EQ(distance(grid_->nearest(const_cast<Node*>(query)), query),
              distance(linear_.nearest(const_cast<Node*>(query)), query));
    same_distances(query, [&](auto& nodes, auto& found) { nodes.nearestK(const_cast<Node*>(query), count, found); });
    same_distances(query, [&](auto& nodes, auto& found) { nodes.nearestR(const_cast<Node*>(query), radius, found); });
    std::vector<Node*> all;
    grid_->list(all);
    EXPECT_EQ(std::multiset<Node*>(all.begin(), all.end()), std::multiset<Node*>(in_.begin(), in_.end()));
    EXPECT_EQ(grid_->size(), in_.size());
  }

  GridNeighbors<Node*>& grid() { return *grid_; }

 private:
  template <typename Ask>
  void same_distances(const Node* query, const Ask& ask) {
    std::vector<Node*> ours;
    std::vector<Node*> theirs;
    ask(*grid_, ours);
    ask(linear_, theirs);
    ASSERT_EQ(ours.size(), theirs.size());
    EXPECT_EQ(std::set<Node*>(ours.begin(), ours.end()).size(), ours.size());
    for (std::size_t i = 0; i < ours.size(); ++i) EXPECT_EQ(distance(ours[i], query), distance(theirs[i], query));
  }

  std::shared_ptr<ob::RealVectorStateSpace> space_;
  Random random_;
  double width_;
  double height_;
  std::unique_ptr<GridNeighbors<Node*>> grid_;
  ompl::NearestNeighborsLinear<Node*> linear_;
  std::vector<std::unique_ptr<Node>> nodes_;
  std::vector<Node*> in_;
};

TEST(GridNeighbors, FindsWhatTheLinearReferenceFinds) {
  Random random(3);
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const double width = std::exp(random.uniform(-2.0, 8.0));
    const double height = width * std::exp(random.uniform(-3.0, 3.0));
    GridAndLinear both(width, height, width * std::exp(random.uniform(-8.0, 1.0)), seed);
    for (int i = 0; i < 300; ++i) {
      both.add();
      if (i % 5 == 4) both.remove();
      if (i % 3 == 0 && i > 5) both.compare(random.index(12), width * std::exp(random.uniform(-6.0, 1.0)));
    }
  }
}

TEST(GridNeighbors, EmptyOnesSaySo) {
  GridAndLinear both(10.0, 10.0, 1.0, 1);
  Node* query = both.make();
  std::vector<Node*> found;
  EXPECT_THROW(both.grid().nearest(query), ompl::Exception);
  both.grid().nearestK(query, 3, found);
  EXPECT_TRUE(found.empty());
  both.grid().nearestR(query, 3.0, found);
  EXPECT_TRUE(found.empty());
  both.add();
  both.grid().clear();
  EXPECT_EQ(both.grid().size(), 0U);
}

}  // namespace
}  // namespace lrrt
