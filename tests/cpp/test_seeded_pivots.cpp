// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "lrrt/sampling/random.hpp"
#include "ompl/seeded_pivots.hpp"

namespace lrrt {
namespace {

namespace ob = ompl::base;

/// Random numbers on a line, far more than a leaf of OMPL's tree takes: it splits them by pivots.
std::vector<double> numbers() {
  Random random(5);
  std::vector<double> drawn(3000);
  for (double& each : drawn) each = random.uniform();
  return drawn;
}

void fill(ompl::NearestNeighbors<double>& neighbors) {
  neighbors.setDistanceFunction([](double a, double b) { return std::abs(a - b); });
  for (const double each : numbers()) neighbors.add(each);
}

/// Nodes in the order of the structure, which its pivots decide.
std::vector<double> order(std::uint64_t seed) {
  SeededPivots<double> pivots(seed);
  fill(pivots);
  std::vector<double> listed;
  pivots.list(listed);
  return listed;
}

TEST(SeededPivots, TheSeedDecidesThem) {
  EXPECT_EQ(order(1), order(1));
  EXPECT_NE(order(1), order(2));
  const ompl::NearestNeighborsGNATNoThreadSafety<double> between;  // draws a seed of the process
  EXPECT_EQ(order(1), order(1));
}

TEST(SeededPivots, SpacesThatAreNoMetricOnesAndChosenStructuresStay) {
  const auto plane = std::make_shared<ob::SpaceInformation>(std::make_shared<ob::RealVectorStateSpace>(2));
  const auto dubins = std::make_shared<ob::SpaceInformation>(std::make_shared<ob::DubinsStateSpace>());
  std::shared_ptr<ompl::NearestNeighbors<double>> neighbors;
  seed_pivots(neighbors, *dubins, 1);
  EXPECT_EQ(neighbors, nullptr);
  seed_pivots(neighbors, *plane, 1);
  ASSERT_NE(neighbors, nullptr);
  const auto chosen = neighbors;
  seed_pivots(neighbors, *plane, 2);
  EXPECT_EQ(neighbors, chosen);
}

}  // namespace
}  // namespace lrrt
