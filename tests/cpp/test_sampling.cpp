// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/planners/rrt/RRT.h>

#include <algorithm>
#include <cmath>

#include "lrrt/error.hpp"
#include "lrrt/ompl/guide.hpp"
#include "lrrt/ompl/map_validity.hpp"
#include "lrrt/sampling/strategy.hpp"
#include "support.hpp"

namespace lrrt {
namespace {

/// Bounds of a share that a fair coin keeps in all but one of a million runs (five standard deviations).
void expect_share(std::size_t hits, std::size_t draws, double share) {
  const double deviation = std::sqrt(share * (1.0 - share) / static_cast<double>(draws));
  EXPECT_NEAR(static_cast<double>(hits) / static_cast<double>(draws), share, 5.0 * deviation + 1e-12);
}

PromisingRegion left_third(const OccupancyMap& map) {
  std::vector<float> probability(map.size(), 0.0F);
  for (int r = 0; r < map.height(); ++r) {
    for (int c = 0; c < map.width() / 3; ++c) probability[map.index({c, r})] = 1.0F;
  }
  return {map, probability, {0, 0}, {0, 0}};
}

TEST(Sampling, RegionDrawsAreUniformOverThePixelsOfTheMask) {
  const OccupancyMap map = test::map_from_rows({".#.", "...", "##."});
  const PromisingRegion region(map, std::vector<float>(9, 1.0F), {0, 0}, {2, 2});
  RegionStrategy strategy(region);
  Random random(1);
  std::vector<std::size_t> hits(9, 0);
  double offset = 0.0;
  constexpr std::size_t draws = 60000;
  for (std::size_t i = 0; i < draws; ++i) {
    const Eigen::Vector2d point = strategy.draw(random);
    const Pixel pixel = OccupancyMap::pixel_of(point);
    ASSERT_TRUE(map.is_free(pixel));
    ++hits[map.index(pixel)];
    offset += point.x() - pixel.c;
  }
  for (int i = 0; i < 9; ++i) {
    if (region.mask()[static_cast<std::size_t>(i)] != 0)
      expect_share(hits[static_cast<std::size_t>(i)], draws, 1.0 / 6.0);
  }
  EXPECT_NEAR(offset / draws, 0.5, 0.01);  // jitter covers the pixel
}

TEST(Sampling, HalfOfTheDrawsComeFromTheMiddleOfABridge) {
  const OccupancyMap map = test::map_from_rows(std::vector<std::string>(20, std::string(40, '.')));
  std::vector<float> probability(map.size(), 1.0F);
  for (int r = 0; r < 20; ++r) {
    for (int c = 15; c < 25; ++c) probability[map.index({c, r})] = 0.0F;
  }
  const PromisingRegion region =
      PromisingRegion(map, probability, {0, 10}, {39, 10}).bridged(map, {0, 10}, {39, 10}, 2);
  ASSERT_EQ(region.bridge().size(), 10U);
  RegionStrategy strategy(region);
  Random random(2);
  constexpr std::size_t draws = 50000;
  std::size_t hits = 0;
  for (std::size_t i = 0; i < draws; ++i) {
    const Pixel pixel = OccupancyMap::pixel_of(strategy.draw(random));
    hits += static_cast<std::size_t>(std::find(region.bridge().begin(), region.bridge().end(), pixel) !=
                                     region.bridge().end());
  }
  expect_share(hits, draws, 0.5 + 0.5 * 10.0 / static_cast<double>(region.area()));
}

TEST(Sampling, AlphaIsTheGuidedShare) {
  const OccupancyMap map = test::map_from_rows(std::vector<std::string>(30, std::string(30, '.')));
  for (const double alpha : {0.0, 0.3, 0.8, 1.0}) {
    MixedSampler sampler(std::make_unique<RegionStrategy>(left_third(map)), UniformStrategy(30, 30), alpha, 7);
    constexpr std::size_t draws = 50000;
    std::size_t left = 0;
    for (std::size_t i = 0; i < draws; ++i) left += static_cast<std::size_t>(sampler.draw().x() < 10.0);
    EXPECT_EQ(sampler.counts().guided + sampler.counts().uniform, draws);
    expect_share(sampler.counts().guided, draws, alpha);
    expect_share(left, draws, alpha + (1.0 - alpha) / 3.0);
  }
}

TEST(Sampling, TheSeedDecidesTheDraws) {
  const auto draw_ten = [](std::uint64_t seed) {
    MixedSampler sampler(nullptr, UniformStrategy(10, 20), 0.5, seed);
    std::vector<double> values;
    for (int i = 0; i < 10; ++i) values.push_back(sampler.draw().y());
    return values;
  };
  EXPECT_EQ(draw_ten(3), draw_ten(3));
  EXPECT_NE(draw_ten(3), draw_ten(4));
}

TEST(Sampling, NonsenseIsRefused) {
  const OccupancyMap map = test::map_from_rows({"."});
  EXPECT_THROW(MixedSampler(nullptr, UniformStrategy(1, 1), 1.01, 1), RequestError);
  EXPECT_THROW(MixedSampler(nullptr, UniformStrategy(1, 1), std::nan(""), 1), RequestError);
  EXPECT_THROW(RegionStrategy(PromisingRegion(map, {0.0F}, {0, 0}, {0, 0})), RequestError);
}

/// A space over a metric map of 30×30 pixels of 0.5 m and a source that draws only from the left third.
struct Guided {
  explicit Guided(double alpha)
      : collision(std::make_shared<CollisionMap>(OccupancyMap(30, 30, walls(), 0.5, {-5.0, 3.0, 0.0}))),
        space(std::make_shared<ompl::base::RealVectorStateSpace>(2)) {
    const Bounds box = collision->map().bounds();
    ompl::base::RealVectorBounds bounds(2);
    for (unsigned int i = 0; i < 2; ++i) {
      bounds.setLow(i, box.low[i]);
      bounds.setHigh(i, box.high[i]);
    }
    space->setBounds(bounds);
    si = std::make_shared<ompl::base::SpaceInformation>(space);
    const auto projection = std::make_shared<PlaneProjection>();
    si->setStateValidityChecker(std::make_shared<MapValidityChecker>(si, collision, projection));
    si->setMotionValidator(std::make_shared<MapMotionValidator>(si, collision, projection));
    si->setup();
    const auto problem = std::make_shared<ompl::base::ProblemDefinition>(si);
    ompl::base::ScopedState<ompl::base::RealVectorStateSpace> start(space);
    start[0] = -4.4;
    start[1] = 3.1;
    problem->setStartAndGoalStates(start, start);
    planner = std::make_shared<ompl::geometric::RRT>(si);
    planner->setProblemDefinition(problem);
    const std::shared_ptr<const OccupancyMap> map(collision, &collision->map());
    source =
        guide(*planner, {map, {std::make_unique<RegionStrategy>(left_third(*map)), UniformStrategy(30, 30), alpha, 5}},
              projection);
  }

  static std::vector<Cell> walls() {
    std::vector<Cell> cells(900, Cell::free);
    for (std::size_t i = 0; i < 900; i += 3) cells[i] = Cell::occupied;
    return cells;
  }

  std::shared_ptr<CollisionMap> collision;
  std::shared_ptr<ompl::base::RealVectorStateSpace> space;
  ompl::base::SpaceInformationPtr si;
  ompl::base::PlannerPtr planner;
  std::shared_ptr<GuidedSource> source;
};

TEST(GuidedSampler, StateSamplersOfTheSpaceDrawFromTheRegionInMapUnits) {
  const Guided guided(1.0);
  const ompl::base::StateSamplerPtr sampler = guided.space->allocStateSampler();
  ompl::base::ScopedState<ompl::base::RealVectorStateSpace> state(guided.space);
  for (int i = 0; i < 2000; ++i) {
    sampler->sampleUniform(state.get());
    ASSERT_GE(state[0], -5.0);
    ASSERT_LE(state[0], 0.0);  // the left third: 10 pixels of 0.5 m from x = -5
    ASSERT_GE(state[1], 3.0);
    ASSERT_LE(state[1], 18.0);
  }
  EXPECT_EQ(guided.source->counts().guided, 2000U);
}

TEST(GuidedSampler, ValidStateSamplersDrawFreeStatesOnly) {
  const Guided guided(0.5);
  const ompl::base::ValidStateSamplerPtr sampler = guided.si->allocValidStateSampler();
  EXPECT_EQ(sampler->getName(), "guided");
  ompl::base::ScopedState<> state(guided.space);
  ompl::base::ScopedState<> near(guided.space);
  for (int i = 0; i < 2000; ++i) {
    ASSERT_TRUE(sampler->sample(state.get()));
    ASSERT_TRUE(guided.si->isValid(state.get()));
    if (sampler->sampleNear(near.get(), state.get(), 1.0)) {
      ASSERT_TRUE(guided.si->isValid(near.get()));
    }
  }
  EXPECT_GT(guided.source->counts().guided, 900U);
}

TEST(MotionValidator, TheLastValidStateIsOnTheEdgeOfTheObstacle) {
  const Guided guided(0.5);
  const auto state = [&](double x, double y) {
    ompl::base::ScopedState<ompl::base::RealVectorStateSpace> s(guided.space);
    s[0] = x;
    s[1] = y;
    return s;
  };
  const auto from = state(-4.4, 3.1);
  const auto to = state(-3.3, 3.1);
  auto last = state(0, 0);
  std::pair<ompl::base::State*, double> valid{last.get(), 0.0};
  EXPECT_FALSE(guided.si->getMotionValidator()->checkMotion(from.get(), to.get(), valid));
  EXPECT_NEAR(last[0], -3.5, 1e-6);  // the wall begins at pixel 3
  EXPECT_NEAR(valid.second, 0.9 / 1.1, 1e-6);
  EXPECT_TRUE(guided.si->isValid(last.get()));
}

TEST(ValidityChecker, ClearanceIsALowerBound) {
  const Guided guided(0.5);
  ompl::base::ScopedState<> state(guided.space);
  const ompl::base::StateSamplerPtr sampler = guided.space->allocStateSampler();
  for (int i = 0; i < 500; ++i) {
    sampler->sampleUniform(state.get());
    const double clearance = guided.si->getStateValidityChecker()->clearance(state.get());
    EXPECT_GE(clearance, 0.0);
    EXPECT_LE(clearance, 0.5);  // a wall is never farther than one pixel here
  }
}

}  // namespace
}  // namespace lrrt
