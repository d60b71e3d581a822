// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <cmath>
#include <memory>

#include "lrrt/error.hpp"
#include "lrrt/ompl/guided_sampler.hpp"
#include "lrrt/ompl/pose_validity.hpp"
#include "lrrt/sampling/frontier.hpp"
#include "support.hpp"

namespace lrrt {
namespace {

namespace ob = ompl::base;

constexpr double pi = 3.141592653589793;

double apart(const Pose2& a, const Pose2& b) {
  return std::hypot(a.x - b.x, a.y - b.y) + std::abs(std::remainder(a.yaw - b.yaw, 2.0 * pi));
}

void bound(ob::SE2StateSpace& space) {
  ob::RealVectorBounds bounds(2);
  bounds.setLow(-1e6);
  bounds.setHigh(1e6);
  space.setBounds(bounds);
}

using Pose = ob::ScopedState<ob::SE2StateSpace>;

void place(Pose& pose, double x, double y, double yaw) {
  pose->setXY(x, y);
  pose->setYaw(wrapped_angle(yaw));
}

void place_anywhere(Pose& pose, Random& random, double side) {
  const double x = random.uniform(-side, side);
  const double y = random.uniform(-side, side);
  place(pose, x, y, random.uniform(-pi, pi));
}

std::vector<std::shared_ptr<ob::SE2StateSpace>> spaces() {
  return {std::make_shared<ob::SE2StateSpace>(), std::make_shared<ob::DubinsStateSpace>(1.7),
          std::make_shared<ForwardSpace>(1.7), std::make_shared<ob::ReedsSheppStateSpace>(1.7)};
}

TEST(PoseMotion, IsTheCurveThatOmplInterpolates) {
  Random random(81);
  for (const auto& space : spaces()) {
    bound(*space);
    const double reach = 0.9;
    const Steering steering(*space, reach);
    Pose from(space);
    Pose to(space);
    Pose between(space);
    for (int i = 0; i < 500; ++i) {
      place_anywhere(from, random, i % 2 == 0 ? 1.0 : 12.0);
      place_anywhere(to, random, i % 2 == 0 ? 1.0 : 12.0);
      const PoseMotion motion = steering.between(from.get(), to.get());
      ASSERT_LT(motion.miss(), 1e-6);
      EXPECT_EQ(apart(motion.at(0.0), pose_of(from.get())), 0.0);
      EXPECT_EQ(apart(motion.at(1.0), pose_of(to.get())), 0.0);
      for (const double t : {1e-9, 0.2, 0.5, 0.77, 1.0 - 1e-9}) {
        space->interpolate(from.get(), to.get(), motion.share(t), between.get());
        EXPECT_LT(apart(motion.at(t), pose_of(between.get())), 1e-6);
      }
    }
  }
}

TEST(PoseMotion, NoPointOfTheRobotIsFasterThanItsSpeed) {
  Random random(82);
  for (const auto& space : spaces()) {
    bound(*space);
    const Steering steering(*space, 2.0);
    Pose from(space);
    Pose to(space);
    for (int i = 0; i < 200; ++i) {
      place_anywhere(from, random, 6.0);
      place_anywhere(to, random, 6.0);
      const PoseMotion motion = steering.between(from.get(), to.get());
      const double angle = random.uniform(-pi, pi);
      const auto farthest_point = [&](double t) {
        const Pose2 pose = motion.at(t);
        return Eigen::Vector2d(pose.x + 2.0 * std::cos(pose.yaw + angle), pose.y + 2.0 * std::sin(pose.yaw + angle));
      };
      const double t0 = random.uniform();
      const double t1 = random.uniform();
      EXPECT_LE((farthest_point(t1) - farthest_point(t0)).norm(), motion.speed() * std::abs(t1 - t0) + 1e-6);
    }
  }
}

TEST(ForwardSpace, ItsCurvesAreAsShortAsOmpls) {
  Random random(83);
  const auto ompls = std::make_shared<ob::DubinsStateSpace>(0.6);
  const auto ours = std::make_shared<ForwardSpace>(0.6);
  bound(*ompls);
  bound(*ours);
  Pose from(ompls);
  Pose to(ompls);
  for (int i = 0; i < 20000; ++i) {
    place_anywhere(from, random, i % 2 == 0 ? 1.0 : 30.0);
    place_anywhere(to, random, i % 2 == 0 ? 1.0 : 30.0);
    ASSERT_NEAR(ours->distance(from.get(), to.get()), ompls->distance(from.get(), to.get()), 1e-9);
  }
}

TEST(ForwardSpace, PosesNearlyInLineDoNoHarm) {
  // OMPL's own curves end the process on some of these.
  Random random(84);
  const auto space = std::make_shared<ForwardSpace>(1.0);
  bound(*space);
  const Steering steering(*space, 1.0);
  Pose from(space);
  Pose to(space);
  for (int i = 0; i < 20000; ++i) {
    const auto nearly = [&] { return random.uniform(-1.0, 1.0) * std::pow(10.0, random.uniform(-17.0, -1.0)); };
    const double length = random.uniform(0.0, 60.0);
    place(from, 0.0, 0.0, nearly());
    place(to, length, nearly(), nearly());
    const PoseMotion motion = steering.between(from.get(), to.get());
    ASSERT_LT(motion.miss(), 1e-5);
    ASSERT_GE(space->distance(from.get(), to.get()), length - 1e-9);
  }
  // along one arc, where the straight line between two turns to the same side has no length
  for (int i = 0; i < 2000; ++i) {
    const double angle = random.uniform(0.0, 3.0);
    place(from, 0.0, -1.0, 0.0);
    place(to, std::sin(angle), -std::cos(angle), angle);
    ASSERT_NEAR(space->distance(from.get(), to.get()), angle, 1e-6);
  }
}

TEST(ForwardSpace, BackwardsItTakesTheCurveThatLeadsToTheFirstState) {
  Random random(85);
  const auto space = std::make_shared<ForwardSpace>(1.3);
  bound(*space);
  Pose from(space);
  Pose to(space);
  Pose between(space);
  Pose same(space);
  for (int i = 0; i < 500; ++i) {
    place_anywhere(from, random, 5.0);
    place_anywhere(to, random, 5.0);
    const double t = random.uniform(0.0, 1.0);
    const double length = space->distance(to.get(), from.get());
    space->interpolate(to.get(), from.get(), 1.0 - t, same.get());
    space->set_backwards(true);
    EXPECT_EQ(space->distance(from.get(), to.get()), length);
    space->interpolate(from.get(), to.get(), t, between.get());
    space->set_backwards(false);
    EXPECT_LT(apart(pose_of(between.get()), pose_of(same.get())), 1e-9);
    EXPECT_NEAR(space->distance(between.get(), from.get()), t * length, 1e-6);
  }
}

/// A wall across the map with a robot on its left.
struct Wall {
  std::shared_ptr<const CollisionBody> body = std::make_shared<const CollisionBody>(
      std::make_shared<const CollisionMap>(
          test::map_from_rows(std::vector<std::string>(30, std::string(30, '.') + "##" + std::string(28, '.')))),
      Polygon::rectangle(6.0, 2.0, 3.0));
};

TEST(PoseValidity, SaysHowFarAMotionIsFree) {
  const Wall wall;
  for (const auto& space : spaces()) {
    ob::RealVectorBounds bounds(2);
    bounds.setLow(0.0);
    bounds.setHigh(60.0);
    space->setBounds(bounds);
    const auto si = std::make_shared<ob::SpaceInformation>(space);
    si->setStateValidityChecker(std::make_shared<PoseValidityChecker>(si, wall.body));
    const auto validator = std::make_shared<PoseMotionValidator>(si, wall.body);
    si->setMotionValidator(validator);
    si->setup();
    Pose from(space);
    Pose to(space);
    Pose last(space);
    place(from, 10.0, 15.0, 0.0);
    place(to, 25.0, 15.0, 0.0);
    EXPECT_TRUE(si->isValid(from.get()));
    EXPECT_TRUE(validator->checkMotion(from.get(), to.get()));
    place(to, 50.0, 15.0, 0.0);
    EXPECT_TRUE(si->isValid(to.get()));
    EXPECT_FALSE(validator->checkMotion(from.get(), to.get()));
    std::pair<ob::State*, double> found{last.get(), -1.0};
    EXPECT_FALSE(validator->checkMotion(from.get(), to.get(), found));
    EXPECT_NEAR(found.second, 17.0 / 40.0, 0.01);  // the front, 3 ahead, meets the wall at 30
    EXPECT_NEAR(last->getX(), 27.0, 0.2);
    EXPECT_EQ(validator->getValidMotionCount(), 1U);
    place(to, 27.5, 15.0, 0.0);
    EXPECT_FALSE(si->isValid(to.get()));
    EXPECT_LE(si->getStateValidityChecker()->clearance(from.get()), 7.0);
    EXPECT_GT(si->getStateValidityChecker()->clearance(from.get()), 4.0);
  }
  ob::RealVectorStateSpace plane(2);
  EXPECT_THROW(Steering(plane, 1.0), RequestError);
  EXPECT_THROW(Steering(ob::DubinsStateSpace(1.0, true), 1.0), RequestError);
}

TEST(GuidedHeadings, FollowTheRegionInAnyFrame) {
  // An L of promising pixels: right along row 10, then down along column 50.
  const int side = 60;
  const OccupancyMap picture(side, side, std::vector<Cell>(side * side, Cell::free));
  const OccupancyMap metric(side, side, picture.cells(), 0.05, {-3.0, 7.0, 0.7});
  for (const OccupancyMap* map : {&picture, &metric}) {
    std::vector<float> probability(map->size(), 0.0F);
    for (int i = 5; i < 55; ++i) {
      for (int k = -2; k <= 2; ++k) {
        probability[map->index({i, 10 + k})] = i <= 52 ? 1.0F : 0.0F;
        probability[map->index({50 + k, i})] = i >= 8 ? 1.0F : 0.0F;
      }
    }
    const Pixel start{6, 10};
    const Pixel goal{50, 53};
    const PromisingRegion region(*map, probability, start, goal);
    const auto shared = std::make_shared<const OccupancyMap>(*map);
    for (const bool can_reverse : {false, true}) {
      auto strategy =
          std::make_unique<FrontierStrategy>(shared, region, start, goal, FrontierOptions{60.0, Growth::batch});
      GuidedSource source({shared, MixedSampler(std::move(strategy), UniformStrategy(side, side), 1.0, 5)},
                          std::make_shared<PoseProjection>(can_reverse), map->center(start), map->center(goal));
      const auto space = std::make_shared<ob::SE2StateSpace>();
      bound(*space);
      const ob::StateSamplerPtr other = space->allocDefaultStateSampler();
      Pose state(space);
      int along = 0;
      int against = 0;
      int draws = 0;
      for (int i = 0; i < 20000; ++i) {
        source.place_guided(state.get(), *other);
        const Eigen::Vector2d at(state->getX(), state->getY());
        const Eigen::Vector2d pixel = map->to_pixel(at);
        if (pixel.x() > 35.0 && pixel.y() < 25.0) continue;  // around the corner
        const Eigen::Vector2d way = pixel.x() < 45.0 ? Eigen::Vector2d(1.0, 0.0) : Eigen::Vector2d(0.0, 1.0);
        const Eigen::Vector2d ahead = (map->to_world(pixel + way) - at).normalized();
        const double cosine = ahead.dot(Eigen::Vector2d(std::cos(state->getYaw()), std::sin(state->getYaw())));
        ++draws;
        along += static_cast<int>(cosine > 0.7);
        against += static_cast<int>(cosine < -0.7);
      }
      ASSERT_GT(draws, 5000);
      // three quarters look ahead or, a tenth of them, back; a quarter of the others does by chance
      const double ahead_share = static_cast<double>(along) / draws;
      const double back_share = static_cast<double>(against) / draws;
      EXPECT_GT(ahead_share, can_reverse ? 0.65 : 0.72);
      EXPECT_NEAR(back_share, can_reverse ? 0.75 * 0.1 + 0.0625 : 0.0625, 0.03);
    }
  }
}

}  // namespace
}  // namespace lrrt
