// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/ompl/drive_space.hpp"

#include <ompl/base/spaces/TimeStateSpace.h>
#include <ompl/control/ControlSampler.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lrrt/ompl/map_projection.hpp"

namespace lrrt {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

constexpr double tau = 6.283185307179586;

using PoseState = ob::SE2StateSpace::StateType;

class DriveControlSampler final : public oc::ControlSampler {
 public:
  DriveControlSampler(const oc::ControlSpace* space, const Drive& drive, std::uint32_t seed)
      : oc::ControlSampler(space), drive_(drive) {
    rng_.setLocalSeed(seed);
  }

  using oc::ControlSampler::sample;
  void sample(oc::Control* control) override {
    const double choice = rng_.uniform01();
    const double speed = rng_.uniform01();
    const Control drawn = drive_.draw(choice, speed, rng_.uniform01());
    double* values = control->as<oc::RealVectorControlSpace::ControlType>()->values;
    values[0] = drawn.speed;
    values[1] = drawn.turn_rate;
  }

 private:
  Drive drive_;
};

void write(const Pose2& pose, double time, ob::State* state) {
  state->as<PoseState>()->setXY(pose.x, pose.y);
  state->as<PoseState>()->setYaw(wrapped_angle(pose.yaw));
  DriveSpace::set_time(time, state);
}

}  // namespace

DriveSpace::DriveSpace(double turn_weight) : turn_weight_(turn_weight) {
  setName("Drive" + getName());
  locked_ = false;
  addSubspace(std::make_shared<ob::TimeStateSpace>(), 0.0);
  lock();
}

ob::State* DriveSpace::allocState() const {
  ob::State* state = ob::SE2StateSpace::allocState();
  set_time(0.0, state);
  return state;
}

double DriveSpace::distance(const ob::State* a, const ob::State* b) const {
  const auto* from = a->as<PoseState>();
  const auto* to = b->as<PoseState>();
  return std::hypot(to->getX() - from->getX(), to->getY() - from->getY()) +
         turn_weight_ * angle_between(to->getYaw(), from->getYaw());
}

double DriveSpace::time(const ob::State* state) {
  return state->as<PoseState>()->as<ob::TimeStateSpace::StateType>(2)->position;
}

void DriveSpace::set_time(double seconds, ob::State* state) {
  state->as<PoseState>()->as<ob::TimeStateSpace::StateType>(2)->position = seconds;
}

DriveControlSpace::DriveControlSpace(const ob::StateSpacePtr& space, const Drive& drive, std::uint32_t seed)
    : oc::RealVectorControlSpace(space, 2), drive_(drive), seed_(seed) {
  ob::RealVectorBounds bounds(2);
  bounds.setLow(0, drive.can_reverse() ? -drive.top_speed() : 0.0);
  bounds.setHigh(0, drive.speed());
  bounds.setLow(1, -drive.top_turn_rate());
  bounds.setHigh(1, drive.top_turn_rate());
  setBounds(bounds);
}

oc::ControlSamplerPtr DriveControlSpace::allocDefaultControlSampler() const {
  return std::make_shared<DriveControlSampler>(this, drive_, seed_);
}

lrrt::Control DriveControlSpace::read(const oc::Control* control, double duration) {
  const double* values = control->as<ControlType>()->values;
  return {values[0], values[1], duration};
}

DrivePropagator::DrivePropagator(const oc::SpaceInformationPtr& si, std::shared_ptr<const CollisionBody> body,
                                 std::shared_ptr<SearchLimits> limits)
    : oc::StatePropagator(si),
      body_(std::move(body)),
      reach_(body_->outline().circumscribed_radius()),
      limits_(std::move(limits)) {}

void DrivePropagator::propagate(const ob::State* state, const oc::Control* control, double duration,
                                ob::State* result) const {
  constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
  const double time = DriveSpace::time(state) + duration;
  const Pose2 from = pose_of(state);
  const lrrt::Control driving = DriveControlSpace::read(control, duration);
  ++checks_;
  const bool interrupted = limits_ && limits_->interrupted_at_motion();
  const bool free = !interrupted && body_->is_free(motion_of(from, driving, reach_));
  write(free ? driven(from, driving) : Pose2{nowhere, nowhere, 0.0}, time, result);
}

DurationObjective::DurationObjective(const ob::SpaceInformationPtr& si, double top_speed)
    : ob::OptimizationObjective(si), top_speed_(top_speed) {
  description_ = "Duration";
}

ob::Cost DurationObjective::stateCost(const ob::State* /*state*/) const {
  return identityCost();
}

ob::Cost DurationObjective::motionCost(const ob::State* from, const ob::State* to) const {
  return ob::Cost(DriveSpace::time(to) - DriveSpace::time(from));
}

PoseGoal::PoseGoal(const ob::SpaceInformationPtr& si, const Pose2& goal, double tolerance, double heading_tolerance,
                   std::uint32_t seed)
    : ob::GoalSampleableRegion(si), goal_(goal), tolerance_(tolerance), heading_tolerance_(heading_tolerance) {
  setThreshold(1.0);
  random_.setLocalSeed(seed);
}

double PoseGoal::distanceGoal(const ob::State* state) const {
  const Pose2 pose = pose_of(state);
  return std::max(std::hypot(pose.x - goal_.x, pose.y - goal_.y) / tolerance_,
                  angle_between(pose.yaw, goal_.yaw) / heading_tolerance_);
}

void PoseGoal::sampleGoal(ob::State* state) const {
  const double off = std::min(heading_tolerance_, tau / 2.0) * random_.uniformReal(-1.0, 1.0);
  write({goal_.x, goal_.y, goal_.yaw + off}, 0.0, state);
}

}  // namespace lrrt
