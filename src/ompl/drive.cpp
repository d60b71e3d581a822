// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/ompl/drive.hpp"

#include <algorithm>
#include <cmath>

namespace lrrt {
namespace {

/// Shares of the controls that go straight on, that turn on the spot where the robot can, and that go backwards where
/// it can.
constexpr double straight_share = 0.1;
constexpr double on_the_spot_share = 0.1;
constexpr double backwards_share = 0.25;
/// By how much rounding may break a limit.
constexpr double rounding = 1e-9;

}  // namespace

Drive::Drive(const PlanRequest& request)
    : is_car_(request.motion == Motion::car),
      speed_(request.speed),
      reverse_speed_(request.reverse_speed),
      turn_rate_(request.turn_rate),
      turning_radius_(request.turning_radius) {}

double Drive::top_speed() const {
  return std::max(speed_, reverse_speed_);
}

double Drive::top_turn_rate() const {
  return is_car_ ? top_speed() / turning_radius_ : turn_rate_;
}

Control Drive::draw(double choice, double speed, double turn) const {
  const bool backwards = can_reverse() && speed < backwards_share;
  const double full_speed = backwards ? -reverse_speed_ : speed_;
  const double to_either_side = 2.0 * turn - 1.0;
  if (choice < straight_share) return {full_speed, 0.0, 0.0};
  if (is_car_) return {full_speed, to_either_side * std::abs(full_speed) / turning_radius_, 0.0};
  if (choice < straight_share + on_the_spot_share) return {0.0, std::copysign(turn_rate_, to_either_side), 0.0};
  // a point of a square, moved away from its middle until one of the two limits is met
  const double ahead = can_reverse()
                           ? (backwards ? speed / backwards_share : (speed - backwards_share) / (1.0 - backwards_share))
                           : speed;
  const double most = std::max(ahead, std::abs(to_either_side));
  if (most <= 0.0) return {full_speed, 0.0, 0.0};
  return {full_speed * ahead / most, turn_rate_ * to_either_side / most, 0.0};
}

bool Drive::allows(const Control& control) const {
  const double most = (control.speed < 0.0 ? reverse_speed_ : speed_) * (1.0 + rounding);
  const double turn_rate = is_car_ ? std::abs(control.speed) / turning_radius_ : turn_rate_;
  return std::abs(control.speed) <= most && std::abs(control.turn_rate) <= turn_rate * (1.0 + rounding);
}

Pose2 driven(const Pose2& from, const Control& control) {
  return along_arc(from, control.speed * control.duration, control.turn_rate * control.duration);
}

PoseMotion motion_of(const Pose2& from, const Control& control, double reach) {
  PoseMotion motion(from, driven(from, control), reach);
  if (control.speed != 0.0) motion.append(control.speed * control.duration, control.turn_rate / control.speed);
  return motion;
}

}  // namespace lrrt
