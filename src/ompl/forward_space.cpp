// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/ompl/forward_space.hpp"

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>

namespace lrrt {
namespace {

namespace ob = ompl::base;
using Eigen::Vector2d;
using Space = ob::DubinsStateSpace;

constexpr double pi = 3.141592653589793;
constexpr double tau = 2.0 * pi;
/// Straight lines shorter than this have no direction worth the name.
constexpr double no_length = 1e-9;

/// Lengths of the three parts of a curve, for a turning radius of 1.
struct Parts {
  double first = std::numeric_limits<double>::infinity();
  double second = 0.0;
  double third = 0.0;

  double length() const { return first + second + third; }
};

/// An angle in [0, 2π); one that rounding may have made less than 0 is 0, not a whole turn.
double positive(double angle, double rounding) {
  const double wrapped = angle - tau * std::floor(angle / tau);
  return tau - wrapped <= rounding ? 0.0 : wrapped;
}

/// A query: from the origin at one heading to a point at another.
struct Query {
  Vector2d to;
  double start;
  double goal;
};

/// Centre of the circle on which a robot turns left, from where it stands.
Vector2d left_of(double heading) {
  return {-std::sin(heading), std::cos(heading)};
}

double direction(const Vector2d& vector) {
  return std::atan2(vector.y(), vector.x());
}

/// How far the direction of a line may be off by rounding, more the shorter it is.
double rounding_of(const Query& query, double length) {
  return 1e-10 + 1e-14 * (1.0 + query.to.norm()) / length;
}

/// Left, straight, left.
Parts left_left(const Query& query) {
  const Vector2d line = query.to + left_of(query.goal) - left_of(query.start);
  const double length = line.norm();
  if (length < no_length) return {0.0, 0.0, positive(query.goal - query.start, 1e-10)};
  const double along = direction(line);
  const double rounding = rounding_of(query, length);
  return {positive(along - query.start, rounding), length, positive(query.goal - along, rounding)};
}

/// Left, straight, right: the line touches both circles from within.
Parts left_right(const Query& query) {
  const Vector2d between = query.to - left_of(query.goal) - left_of(query.start);
  const double squared = between.squaredNorm() - 4.0;
  if (squared < -1e-12) return {};
  const double length = std::sqrt(std::max(0.0, squared));
  const double along = direction(between) + std::atan2(2.0, length);
  const double rounding = rounding_of(query, 1.0);
  return {positive(along - query.start, rounding), length, positive(along - query.goal, rounding)};
}

/// Left, right, left: the circle in the middle touches both others. Of the two that do, the one with the longer way
/// round belongs to the shortest curves.
Parts left_right_left(const Query& query) {
  const Vector2d between = query.to + left_of(query.goal) - left_of(query.start);
  const double apart = between.norm();
  if (apart > 4.0) return {};
  const double aside = std::acos(apart / 4.0);
  const double onto = direction(between) + aside + pi / 2.0;
  const double off = direction(between) - aside - pi / 2.0;
  return {positive(onto - query.start, 1e-10), pi + 2.0 * aside, positive(query.goal - off, 1e-10)};
}

/// The query in a mirror, in which left is right.
Query mirrored(const Query& query) {
  return {{query.to.x(), -query.to.y()}, -query.start, -query.goal};
}

}  // namespace

Space::DubinsPath ForwardSpace::curve(const ob::State* from, const ob::State* to) const {
  const auto* start = from->as<StateType>();
  const auto* goal = to->as<StateType>();
  const Query query{Vector2d(goal->getX() - start->getX(), goal->getY() - start->getY()) / rho_, start->getYaw(),
                    goal->getYaw()};
  const Query mirror = mirrored(query);
  // in the order of OMPL's dubinsPathType: LSL, RSR, RSL, LSR, RLR, LRL
  const std::array<Parts, 6> candidates = {left_left(query),  left_left(mirror),       left_right(mirror),
                                           left_right(query), left_right_left(mirror), left_right_left(query)};
  std::size_t best = 0;
  for (std::size_t i = 1; i < candidates.size(); ++i) {
    if (candidates[i].length() < candidates[best].length()) best = i;
  }
  const Parts& parts = candidates[best];
  return {dubinsPathType[best], parts.first, parts.second, parts.third};
}

void ForwardSpace::interpolate(const ob::State* from, const ob::State* to, double t, ob::State* state) const {
  bool first_time = true;
  DubinsPath path;
  interpolate(from, to, t, first_time, path, state);
}

void ForwardSpace::interpolate(const ob::State* from, const ob::State* to, double t, bool& first_time, DubinsPath& path,
                               ob::State* state) const {
  if (t <= 0.0 || t >= 1.0) {
    if (t >= 1.0 && to != state) copyState(state, to);
    if (t <= 0.0 && from != state) copyState(state, from);
    return;
  }
  if (first_time) path = backwards_ ? curve(to, from) : curve(from, to);
  first_time = false;
  ob::DubinsStateSpace::interpolate(backwards_ ? to : from, path, backwards_ ? 1.0 - t : t, state);
}

}  // namespace lrrt
