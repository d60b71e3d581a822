// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/ompl/guided_sampler.hpp"

#include <ompl/base/SpaceInformation.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace lrrt {

namespace ob = ompl::base;

namespace {

/// Share of the guided states that look along the way to the goal, how far off it they look at most, and the share of
/// those that look back where the robot can reverse.
constexpr double aligned_share = 0.75;
constexpr double spread = 0.5235987755982988;  // 30°
constexpr double backwards_share = 0.1;
constexpr double pi = 3.141592653589793;

}  // namespace

GuidedValidStateSampler::GuidedValidStateSampler(const ob::SpaceInformation* si, std::shared_ptr<GuidedSource> source)
    : ob::ValidStateSampler(si), source_(std::move(source)), uniform_(si->getStateSpace()->allocDefaultStateSampler()) {
  name_ = "guided";
}

bool GuidedValidStateSampler::sample(ob::State* state) {
  if (source_->ended(*si_->getStateSpace(), state)) return true;
  for (unsigned int attempt = 0; attempt < attempts_; ++attempt) {
    source_->place(state, *uniform_);
    if (si_->isValid(state)) return true;
  }
  return false;
}

bool GuidedValidStateSampler::sampleNear(ob::State* state, const ob::State* near, double distance) {
  if (source_->ended(*si_->getStateSpace(), state)) return true;
  const bool guided = source_->wants_guided();
  for (unsigned int attempt = 0; attempt < attempts_; ++attempt) {
    // the last attempts take any free state: nothing promising may lie near
    const bool choosy = guided && 2 * attempt < attempts_;
    source_->place_near(state, near, distance, *uniform_);
    if ((choosy && !source_->promising(state)) || !si_->isValid(state)) continue;
    source_->count(choosy);
    return true;
  }
  return false;
}

GuidedStateSampler::GuidedStateSampler(const ob::StateSpace* space, std::shared_ptr<GuidedSource> source)
    : ob::StateSampler(space), source_(std::move(source)), uniform_(space->allocDefaultStateSampler()) {}

void GuidedStateSampler::sampleUniform(ob::State* state) {
  if (!source_->ended(*space_, state)) source_->place(state, *uniform_);
}

void GuidedStateSampler::sampleUniformNear(ob::State* state, const ob::State* near, double distance) {
  if (!source_->ended(*space_, state)) source_->place_near(state, near, distance, *uniform_);
}

void GuidedStateSampler::sampleGaussian(ob::State* state, const ob::State* mean, double deviation) {
  uniform_->sampleGaussian(state, mean, deviation);
}

ObservingMotionValidator::ObservingMotionValidator(ob::SpaceInformation* si, ob::MotionValidatorPtr inner,
                                                   std::shared_ptr<GuidedSource> source)
    : ob::MotionValidator(si), inner_(std::move(inner)), source_(std::move(source)) {}

bool ObservingMotionValidator::noted(bool free, const ob::State* from, const ob::State* to) const {
  ++(free ? valid_ : invalid_);
  if (free) source_->connected(from, to);
  return free;
}

bool ObservingMotionValidator::checkMotion(const ob::State* from, const ob::State* to) const {
  return noted(inner_->checkMotion(from, to), from, to);
}

bool ObservingMotionValidator::checkMotion(const ob::State* from, const ob::State* to,
                                           std::pair<ob::State*, double>& last_valid) const {
  return noted(inner_->checkMotion(from, to, last_valid), from, to);
}

void GuidedSource::write_whole(const Eigen::Vector2d& point, ob::State* state) {
  projection_->write(map_->to_world(point), state);
  if (projection_->has_heading()) projection_->write_heading(2.0 * pi * sampler_.draw_number(), state);
}

void GuidedSource::write(const Eigen::Vector2d& point, ob::State* state, ob::StateSampler& other) {
  if (projection_->is_whole_state()) {
    write_whole(point, state);
  } else {
    other.sampleUniform(state);
    projection_->write(map_->to_world(point), state);
  }
}

void GuidedSource::place(ob::State* state, ob::StateSampler& other) {
  const bool guided = sampler_.wants_guided();
  sampler_.count(guided);
  guided ? place_guided(state, other) : write(sampler_.draw_uniform(), state, other);
}

void GuidedSource::place_guided(ob::State* state, ob::StateSampler& other) {
  const Eigen::Vector2d point = sampler_.draw_guided();
  write(point, state, other);
  if (projection_->has_heading()) align(point, state);
}

void GuidedSource::align(const Eigen::Vector2d& point, ob::State* state) {
  if (sampler_.draw_number() >= aligned_share) return;
  const std::optional<Eigen::Vector2d> direction = sampler_.direction(point);
  if (!direction) return;
  const Eigen::Vector2d ahead = map_->to_world(point + *direction) - map_->to_world(point);
  double heading = std::atan2(ahead.y(), ahead.x()) + spread * (2.0 * sampler_.draw_number() - 1.0);
  if (projection_->can_reverse() && sampler_.draw_number() < backwards_share) heading += pi;
  projection_->write_heading(heading, state);
}

void GuidedSource::place_near(ob::State* state, const ob::State* near, double distance, ob::StateSampler& other) {
  if (!projection_->is_whole_state()) {
    other.sampleUniformNear(state, near, distance);
    return;
  }
  const double reach = distance / map_->resolution();
  const double heading = projection_->read_heading(near);
  write_whole(sampler_.draw_near(pixel_point(near), reach), state);
  if (projection_->has_heading()) projection_->write_heading(heading + pi * (sampler_.draw_number() - 0.5), state);
}

void GuidedSource::place_informed(ob::State* state, double length) {
  write_whole(sampler_.draw_informed(start_, goal_, length / map_->resolution()), state);
}

void GuidedSource::improved(const std::vector<const ob::State*>& states, double length) {
  std::vector<Eigen::Vector2d> path;
  path.reserve(states.size() + 2);
  for (const ob::State* state : states) path.push_back(pixel_point(state));
  const auto apart = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return (a - b).norm(); };
  if (!path.empty() && apart(path.back(), start_) + apart(path.front(), goal_) <
                           apart(path.front(), start_) + apart(path.back(), goal_)) {
    std::reverse(path.begin(), path.end());
  }
  if (path.empty() || path.front() != start_) path.insert(path.begin(), start_);
  if (path.back() != goal_) path.push_back(goal_);
  sampler_.improved(path, length / map_->resolution());
}

}  // namespace lrrt
