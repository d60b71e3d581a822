// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/ompl/pose_motion.hpp"

#include <ompl/base/ScopedState.h>

#include <algorithm>
#include <cmath>

#include "lrrt/error.hpp"

namespace lrrt {
namespace {

namespace ob = ompl::base;

constexpr double tau = 6.283185307179586;

double distance(const Pose2& a, const Pose2& b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}

/// OMPL's curves come for a turning radius of 1 and its spaces do not tell theirs: a straight line shows it.
template <typename Space, typename Curve>
double turning_radius_of(const Space& space, const Curve& curve) {
  auto* from = space.allocState()->template as<ob::SE2StateSpace::StateType>();
  auto* to = space.allocState()->template as<ob::SE2StateSpace::StateType>();
  from->setXY(0.0, 0.0);
  from->setYaw(0.0);
  to->setXY(1.0, 0.0);
  to->setYaw(0.0);
  const double radius = space.distance(from, to) / curve(from, to).length();
  space.freeState(from);
  space.freeState(to);
  return radius;
}

}  // namespace

PoseMotion::PoseMotion(const Pose2& from, const Pose2& to, double reach)
    : from_(from),
      to_(to),
      turn_(std::remainder(to.yaw - from.yaw, tau)),
      reach_(reach),
      speed_(distance(from, to) + reach * std::abs(turn_)),
      end_(from) {}

Pose2 along_arc(const Pose2& from, double length, double turn) {
  const double half_turn = 0.5 * turn;
  const double chord = half_turn == 0.0 ? length : length * std::sin(half_turn) / half_turn;
  const double direction = from.yaw + half_turn;
  return {from.x + chord * std::cos(direction), from.y + chord * std::sin(direction), from.yaw + turn};
}

double arc_length(const Pose2& from, const Pose2& to) {
  const double half = 0.5 * std::remainder(to.yaw - from.yaw, tau);
  const double ahead = std::cos(from.yaw + half) * (to.x - from.x) + std::sin(from.yaw + half) * (to.y - from.y);
  return std::copysign(half == 0.0 ? distance(from, to) : distance(from, to) * half / std::sin(half), ahead);
}

void PoseMotion::append(double length, double curvature) {
  if (count_ == 0) speed_ = 0.0;
  Piece& piece = pieces_.at(count_++);
  piece = {end_, length, curvature, speed_, 1.0 + reach_ * std::abs(curvature)};
  speed_ += piece.pace * std::abs(length);
  end_ = along_arc(end_, length, curvature * length);
}

PoseMotion PoseMotion::arc(const Pose2& from, const Pose2& to, double reach) {
  PoseMotion motion(from, to, reach);
  const double length = arc_length(from, to);
  if (length != 0.0) motion.append(length, motion.turn_ / length);
  return motion;
}

const PoseMotion::Piece& PoseMotion::piece_at(double spent) const {
  std::size_t i = count_ - 1;
  while (i > 0 && pieces_[i].begin > spent) --i;
  return pieces_[i];
}

Pose2 PoseMotion::at(double t) const {
  if (t <= 0.0) return from_;
  if (t >= 1.0) return to_;
  if (count_ == 0) return {from_.x + t * (to_.x - from_.x), from_.y + t * (to_.y - from_.y), from_.yaw + t * turn_};
  const Piece& piece = piece_at(t * speed_);
  const double length = std::copysign((t * speed_ - piece.begin) / piece.pace, piece.length);
  return along_arc(piece.from, length, piece.curvature * length);
}

std::vector<double> PoseMotion::moments(double spacing) const {
  std::vector<double> found;
  const auto divide = [&](double begin, double end) {
    const auto steps = static_cast<std::size_t>(std::ceil((end - begin) * speed_ / spacing));
    for (std::size_t i = 1; i <= steps; ++i) {
      found.push_back(begin + (end - begin) * static_cast<double>(i) / static_cast<double>(steps));
    }
  };
  for (std::size_t i = 0; i < count_; ++i) {
    const double end = i + 1 < count_ ? pieces_[i + 1].begin : speed_;
    if (speed_ > 0.0) divide(pieces_[i].begin / speed_, end / speed_);
  }
  if (count_ == 0) divide(0.0, 1.0);
  if (found.empty()) found.push_back(1.0);
  found.back() = 1.0;
  return found;
}

double PoseMotion::share(double t) const {
  if (count_ == 0) return t;
  double before = 0.0;
  double whole = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    const double length = std::abs(pieces_[i].length);
    before += std::clamp((t * speed_ - pieces_[i].begin) / pieces_[i].pace, 0.0, length);
    whole += length;
  }
  return whole > 0.0 ? std::min(1.0, before / whole) : t;
}

double PoseMotion::miss() const {
  return count_ == 0 ? 0.0 : distance(end_, to_) + reach_ * std::abs(std::remainder(to_.yaw - end_.yaw, tau));
}

Steering::Steering(const ob::StateSpace& space, double reach)
    : forward_(dynamic_cast<const ForwardSpace*>(&space)),
      dubins_(dynamic_cast<const ob::DubinsStateSpace*>(&space)),
      reeds_shepp_(dynamic_cast<const ob::ReedsSheppStateSpace*>(&space)),
      reach_(reach) {
  if (dynamic_cast<const ob::SE2StateSpace*>(&space) == nullptr) {
    throw RequestError("state space '" + space.getName() +
                       "' has no poses: expected OMPL's SE2StateSpace, DubinsStateSpace or ReedsSheppStateSpace");
  }
  if (dubins_ != nullptr && dubins_->hasSymmetricInterpolate()) {
    throw RequestError("state space '" + space.getName() +
                       "' is a symmetric Dubins space, whose robot drives some curves backwards: use "
                       "ReedsSheppStateSpace, or a Dubins space that is not symmetric");
  }
  if (dubins_ != nullptr) {
    turning_radius_ = turning_radius_of(*dubins_, [&](auto* a, auto* b) { return dubins_curve(a, b); });
  } else if (reeds_shepp_ != nullptr) {
    turning_radius_ =
        turning_radius_of(*reeds_shepp_, [&](auto* a, auto* b) { return reeds_shepp_->reedsShepp(a, b); });
  }
}

ob::DubinsStateSpace::DubinsPath Steering::dubins_curve(const ob::State* from, const ob::State* to) const {
  return forward_ != nullptr ? forward_->curve(from, to) : dubins_->dubins(from, to);
}

PoseMotion Steering::between(const ob::State* from, const ob::State* to) const {
  PoseMotion motion(pose_of(from), pose_of(to), reach_);
  const auto drive = [&](double length, bool straight, bool left) {
    motion.append(length * turning_radius_, (straight ? 0.0 : left ? 1.0 : -1.0) / turning_radius_);
  };
  if (dubins_ != nullptr) {
    const ob::DubinsStateSpace::DubinsPath path = dubins_curve(from, to);
    for (int i = 0; i < 3; ++i) {
      const auto kind = path.type_[i];
      drive(path.length_[i], kind == ob::DubinsStateSpace::DUBINS_STRAIGHT, kind == ob::DubinsStateSpace::DUBINS_LEFT);
    }
  } else if (reeds_shepp_ != nullptr) {
    const ob::ReedsSheppStateSpace::ReedsSheppPath path = reeds_shepp_->reedsShepp(from, to);
    for (int i = 0; i < 5; ++i) {
      const auto kind = path.type_[i];
      if (kind == ob::ReedsSheppStateSpace::RS_NOP) break;
      drive(path.length_[i], kind == ob::ReedsSheppStateSpace::RS_STRAIGHT, kind == ob::ReedsSheppStateSpace::RS_LEFT);
    }
  }
  return motion;
}

Pose2 pose_of(const ob::State* state) {
  const auto* pose = state->as<ob::SE2StateSpace::StateType>();
  return {pose->getX(), pose->getY(), pose->getYaw()};
}

}  // namespace lrrt
