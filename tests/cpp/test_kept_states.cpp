// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/control/spaces/RealVectorControlSpace.h>

#include <set>
#include <vector>

#include "ompl/kept_states.hpp"

namespace lrrt {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

/// Counts what is alive.
class Counting : public ob::RealVectorStateSpace {
 public:
  explicit Counting(int& alive) : ob::RealVectorStateSpace(2), alive_(alive) {}
  ob::State* allocState() const override {
    ++alive_;
    return ob::RealVectorStateSpace::allocState();
  }
  void freeState(ob::State* state) const override {
    --alive_;
    ob::RealVectorStateSpace::freeState(state);
  }

 private:
  int& alive_;
};

TEST(KeptStates, WhatAPlannerForgetsIsFreedWithTheSpace) {
  int alive = 0;
  {
    const KeptStates<Counting> space(alive);
    for (int i = 0; i < 100; ++i) {
      ob::State* state = space.allocState();
      if (i % 3 == 0) space.freeState(state);
    }
    EXPECT_GE(alive, 66);
  }
  EXPECT_EQ(alive, 0);
}

TEST(KeptStates, StatesAreUsedAgainButNeverTwiceAtOnce) {
  int alive = 0;
  const KeptStates<Counting> space(alive);
  std::vector<ob::State*> used;
  for (int round = 0; round < 20; ++round) {
    for (int i = 0; i < 50; ++i) used.push_back(space.allocState());
    EXPECT_EQ(std::set<ob::State*>(used.begin(), used.end()).size(), used.size());
    for (ob::State* state : used) space.freeState(state);
    used.clear();
  }
  EXPECT_EQ(alive, 50);
}

TEST(KeptControls, AreUsedAgain) {
  const auto states = std::make_shared<ob::RealVectorStateSpace>(2);
  const KeptControls<oc::RealVectorControlSpace> space(states, 2);
  oc::Control* first = space.allocControl();
  oc::Control* second = space.allocControl();
  EXPECT_NE(first, second);
  space.freeControl(first);
  EXPECT_EQ(space.allocControl(), first);
}

}  // namespace
}  // namespace lrrt
