// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/ompl/guided_sampler.hpp"

#include <ompl/base/SpaceInformation.h>

#include <utility>

namespace lrrt {

namespace ob = ompl::base;

GuidedValidStateSampler::GuidedValidStateSampler(const ob::SpaceInformation* si, std::shared_ptr<GuidedSource> source)
    : ob::ValidStateSampler(si), source_(std::move(source)), uniform_(si->getStateSpace()->allocDefaultStateSampler()) {
  name_ = "guided";
}

bool GuidedValidStateSampler::sample(ob::State* state) {
  for (unsigned int attempt = 0; attempt < attempts_; ++attempt) {
    uniform_->sampleUniform(state);
    source_->place(state);
    if (si_->isValid(state)) return true;
  }
  return false;
}

bool GuidedValidStateSampler::sampleNear(ob::State* state, const ob::State* near, double distance) {
  for (unsigned int attempt = 0; attempt < attempts_; ++attempt) {
    uniform_->sampleUniformNear(state, near, distance);
    if (si_->isValid(state)) return true;
  }
  return false;
}

GuidedStateSampler::GuidedStateSampler(const ob::StateSpace* space, std::shared_ptr<GuidedSource> source)
    : ob::StateSampler(space), source_(std::move(source)), uniform_(space->allocDefaultStateSampler()) {}

void GuidedStateSampler::sampleUniform(ob::State* state) {
  uniform_->sampleUniform(state);
  source_->place(state);
}

void GuidedStateSampler::sampleUniformNear(ob::State* state, const ob::State* near, double distance) {
  uniform_->sampleUniformNear(state, near, distance);
}

void GuidedStateSampler::sampleGaussian(ob::State* state, const ob::State* mean, double deviation) {
  uniform_->sampleGaussian(state, mean, deviation);
}

void use_guided_sampler(ob::SpaceInformation& si, const std::shared_ptr<GuidedSource>& source) {
  si.getStateSpace()->setStateSamplerAllocator(
      [source](const ob::StateSpace* space) { return std::make_shared<GuidedStateSampler>(space, source); });
  si.setValidStateSamplerAllocator([source](const ob::SpaceInformation* information) {
    return std::make_shared<GuidedValidStateSampler>(information, source);
  });
}

}  // namespace lrrt
