// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/ompl/guided_sampler.hpp"

#include <ompl/base/SpaceInformation.h>

#include <algorithm>
#include <utility>

namespace lrrt {

namespace ob = ompl::base;

GuidedValidStateSampler::GuidedValidStateSampler(const ob::SpaceInformation* si, std::shared_ptr<GuidedSource> source)
    : ob::ValidStateSampler(si), source_(std::move(source)), uniform_(si->getStateSpace()->allocDefaultStateSampler()) {
  name_ = "guided";
}

bool GuidedValidStateSampler::sample(ob::State* state) {
  for (unsigned int attempt = 0; attempt < attempts_; ++attempt) {
    source_->place(state, *uniform_);
    if (si_->isValid(state)) return true;
  }
  return false;
}

bool GuidedValidStateSampler::sampleNear(ob::State* state, const ob::State* near, double distance) {
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
  source_->place(state, *uniform_);
}

void GuidedStateSampler::sampleUniformNear(ob::State* state, const ob::State* near, double distance) {
  source_->place_near(state, near, distance, *uniform_);
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

void GuidedSource::place_near(ob::State* state, const ob::State* near, double distance, ob::StateSampler& other) {
  if (!projection_->is_whole_state()) {
    other.sampleUniformNear(state, near, distance);
    return;
  }
  const double reach = distance / map_->map().resolution();
  projection_->write(map_->map().to_world(sampler_.draw_near(pixel_point(near), reach)), state);
}

bool GuidedSource::place_informed(ob::State* state, double length) {
  if (!projection_->is_whole_state()) return false;
  const Eigen::Vector2d point = sampler_.draw_informed(start_, goal_, length / map_->map().resolution());
  projection_->write(map_->map().to_world(point), state);
  return true;
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
  sampler_.improved(path, length / map_->map().resolution());
}

}  // namespace lrrt
