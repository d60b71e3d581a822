// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>

#include <array>
#include <cmath>
#include <memory>

#include "lrrt/map/footprint.hpp"
#include "lrrt/ompl/drive.hpp"
#include "lrrt/ompl/drive_space.hpp"
#include "pose_support.hpp"
#include "support.hpp"

namespace lrrt {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

constexpr double pi = 3.141592653589793;

/// A request is all that a Drive needs; the map does not count.
PlanRequest request_for(const OccupancyMap& map, Motion motion, bool reverses) {
  PlanRequest request{map, {0.5, 0.5}, {1.5, 0.5}};
  request.motion = motion;
  request.speed = 3.0;
  request.reverse_speed = reverses ? 1.5 : 0.0;
  request.turn_rate = 0.7;
  request.turning_radius = 4.0;
  return request;
}

TEST(Drive, ControlsKeepTheLimitsAndNoneIsSlowerThanItHasToBe) {
  const OccupancyMap map = test::map_from_rows({".."});
  Random random(81);
  for (const Motion motion : {Motion::unicycle, Motion::car}) {
    for (const bool reverses : {false, true}) {
      const Drive drive(request_for(map, motion, reverses));
      int backwards = 0;
      std::array<int, 4> quarters{};  // of the turns, from right to left
      for (int i = 0; i < 4000; ++i) {
        const Control control = drive.draw(random.uniform(), random.uniform(), random.uniform());
        ASSERT_TRUE(drive.allows(control)) << control.speed << " " << control.turn_rate;
        const double full = control.speed < 0.0 ? 1.5 : 3.0;
        const bool fastest = std::abs(std::abs(control.speed) - full) < 1e-9 ||
                             (motion == Motion::unicycle && std::abs(std::abs(control.turn_rate) - 0.7) < 1e-9);
        EXPECT_TRUE(fastest) << control.speed << " " << control.turn_rate;
        if (motion == Motion::car) {
          EXPECT_LE(std::abs(control.turn_rate) * 4.0, std::abs(control.speed) + 1e-9);
        }
        backwards += static_cast<int>(control.speed < 0.0);
        const double share = 0.5 + 0.5 * control.turn_rate / drive.top_turn_rate();
        ++quarters.at(static_cast<std::size_t>(std::min(3.0, 4.0 * share)));
      }
      EXPECT_EQ(backwards > 0, reverses);
      for (const int quarter : quarters) EXPECT_GT(quarter, 400);
    }
  }
}

TEST(Drive, WhatBreaksALimitIsNotAllowed) {
  const OccupancyMap map = test::map_from_rows({".."});
  const Drive car(request_for(map, Motion::car, true));
  EXPECT_TRUE(car.allows({3.0, 0.75, 9.0}));
  EXPECT_FALSE(car.allows({3.0, 0.76, 9.0}));
  EXPECT_FALSE(car.allows({1.0, 0.3, 9.0}));
  EXPECT_FALSE(car.allows({3.1, 0.0, 9.0}));
  EXPECT_FALSE(car.allows({-1.6, 0.0, 9.0}));
  const Drive unicycle(request_for(map, Motion::unicycle, false));
  EXPECT_TRUE(unicycle.allows({0.0, -0.7, 1.0}));
  EXPECT_FALSE(unicycle.allows({0.0, -0.71, 1.0}));
  EXPECT_FALSE(unicycle.allows({-0.1, 0.0, 1.0}));
}

TEST(Drive, AControlLeadsWhereSmallStepsLead) {
  Random random(82);
  for (int i = 0; i < 200; ++i) {
    const Pose2 from{random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-pi, pi)};
    const Control control{i % 5 == 0 ? 0.0 : random.uniform(-2, 2), i % 7 == 0 ? 0.0 : random.uniform(-2, 2),
                          random.uniform(0.0, 1.5)};
    Pose2 pose = from;
    constexpr int steps = 4000;
    const double time = control.duration / steps;
    for (int k = 0; k < steps; ++k) {
      const double middle = pose.yaw + 0.5 * control.turn_rate * time;
      pose = {pose.x + control.speed * time * std::cos(middle), pose.y + control.speed * time * std::sin(middle),
              pose.yaw + control.turn_rate * time};
    }
    const Pose2 to = driven(from, control);
    EXPECT_NEAR(to.x, pose.x, 1e-6);
    EXPECT_NEAR(to.y, pose.y, 1e-6);
    EXPECT_NEAR(to.yaw, pose.yaw, 1e-9);
    const PoseMotion motion = motion_of(from, control, 1.0);
    const Pose2 half = driven(from, {control.speed, control.turn_rate, 0.5 * control.duration});
    EXPECT_NEAR(motion.at(0.5).x, half.x, 1e-9);
    EXPECT_NEAR(motion.at(0.5).y, half.y, 1e-9);
    EXPECT_LT(test::angle_between(motion.at(0.5).yaw, half.yaw), 1e-9);
    EXPECT_LT(motion.miss(), 1e-9);
  }
}

/// A small robot on a map with a wall of one pixel.
struct Walled {
  Walled() {
    std::vector<std::string> rows(21, std::string(41, '.'));
    for (std::string& row : rows) row[20] = '#';
    const auto map = std::make_shared<const CollisionMap>(test::map_from_rows(rows));
    body = std::make_shared<const CollisionBody>(map, Polygon::rectangle(2.0, 1.0, 1.0));
    space = std::make_shared<DriveSpace>(2.0);
    ob::RealVectorBounds bounds(2);
    bounds.setLow(0.0);
    bounds.setHigh(41.0);
    space->setBounds(bounds);
    const PlanRequest request = request_for(map->map(), Motion::unicycle, true);
    controls = std::make_shared<DriveControlSpace>(space, Drive(request), 1U);
    si = std::make_shared<oc::SpaceInformation>(space, controls);
    si->setStateValidityChecker(std::make_shared<PoseValidityChecker>(si, body));
    si->setStatePropagator(std::make_shared<DrivePropagator>(si, body));
    si->setPropagationStepSize(4.0);
    si->setMinMaxControlDuration(1, 4);
    si->setup();
  }

  std::shared_ptr<const CollisionBody> body;
  std::shared_ptr<DriveSpace> space;
  std::shared_ptr<DriveControlSpace> controls;
  oc::SpaceInformationPtr si;
};

TEST(DrivePropagation, NoStepJumpsOverAWall) {
  const Walled scene;
  ob::ScopedState<ob::SE2StateSpace> from(scene.space);
  from->setXY(14.0, 10.5);
  from->setYaw(0.0);
  ob::ScopedState<ob::SE2StateSpace> to(scene.space);
  oc::Control* control = scene.si->allocControl();
  auto* values = control->as<oc::RealVectorControlSpace::ControlType>()->values;
  values[0] = 3.0;  // twelve pixels a step: both ends of the first step are free, the wall is between them
  values[1] = 0.0;
  EXPECT_EQ(scene.si->propagateWhileValid(from.get(), control, 3, to.get()), 0U);
  EXPECT_EQ(pose_of(to.get()).x, 14.0);
  values[0] = 1.0;  // four pixels a step: the wall is met in the second
  EXPECT_EQ(scene.si->propagateWhileValid(from.get(), control, 3, to.get()), 1U);
  EXPECT_DOUBLE_EQ(pose_of(to.get()).x, 18.0);
  EXPECT_DOUBLE_EQ(DriveSpace::time(to.get()), 4.0);
  values[0] = 0.0;  // turned on the spot
  values[1] = 0.5;
  EXPECT_EQ(scene.si->propagateWhileValid(from.get(), control, 3, to.get()), 3U);
  EXPECT_LT(test::angle_between(pose_of(to.get()).yaw, 6.0), 1e-12);
  EXPECT_DOUBLE_EQ(DriveSpace::time(to.get()), 12.0);
  scene.si->freeControl(control);
}

TEST(DrivePropagation, TimeCostsButLiesNowhere) {
  const Walled scene;
  ob::ScopedState<ob::SE2StateSpace> a(scene.space);
  ob::ScopedState<ob::SE2StateSpace> b(scene.space);
  EXPECT_EQ(DriveSpace::time(a.get()), 0.0);
  a->setXY(1.0, 1.0);
  a->setYaw(3.0);
  b->setXY(4.0, 5.0);
  b->setYaw(-3.0);
  DriveSpace::set_time(2.0, a.get());
  DriveSpace::set_time(7.5, b.get());
  EXPECT_NEAR(scene.space->distance(a.get(), b.get()), 5.0 + 2.0 * (2.0 * pi - 6.0), 1e-12);
  EXPECT_EQ(scene.space->distance(a.get(), b.get()), scene.space->distance(b.get(), a.get()));
  const DurationObjective objective(scene.si, 3.0);
  EXPECT_DOUBLE_EQ(objective.motionCost(a.get(), b.get()).value(), 5.5);
}

TEST(DrivePropagation, AGoalTakesWhatBothTolerancesTake) {
  const Walled scene;
  const PoseGoal goal(scene.si, {10.0, 10.0, 3.0}, 2.0, 0.5, 1U);
  ob::ScopedState<ob::SE2StateSpace> state(scene.space);
  const auto reached = [&](double x, double y, double yaw) {
    state->setXY(x, y);
    state->setYaw(yaw);
    return goal.isSatisfied(state.get());
  };
  EXPECT_TRUE(reached(11.9, 10.0, 3.0));
  EXPECT_FALSE(reached(12.1, 10.0, 3.0));
  EXPECT_TRUE(reached(10.0, 10.0, -2.8));
  EXPECT_FALSE(reached(10.0, 10.0, -2.7));
  for (int i = 0; i < 100; ++i) {
    goal.sampleGoal(state.get());
    EXPECT_TRUE(goal.isSatisfied(state.get()));
    EXPECT_EQ(pose_of(state.get()).x, 10.0);
  }
}

}  // namespace
}  // namespace lrrt
