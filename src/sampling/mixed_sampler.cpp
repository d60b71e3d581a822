// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/sampling/mixed_sampler.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "lrrt/error.hpp"

namespace lrrt {

MixedSampler::MixedSampler(std::unique_ptr<SamplingStrategy> guided, const UniformStrategy& uniform, double alpha,
                           std::uint64_t seed)
    : guided_(std::move(guided)), uniform_(uniform), alpha_(alpha), random_(seed) {
  if (!(alpha >= 0.0 && alpha <= 1.0)) {
    throw RequestError("alpha " + std::to_string(alpha) + ": expected a share of guided samples from 0 to 1");
  }
}

Eigen::Vector2d MixedSampler::draw() {
  const bool guided = wants_guided();
  count(guided);
  return guided ? draw_guided() : uniform_.draw(random_);
}

Eigen::Vector2d MixedSampler::draw_informed(const Eigen::Vector2d& start, const Eigen::Vector2d& goal, double length) {
  if (std::isfinite(length)) uniform_.inform(start, goal, length);
  return uniform_.draw(random_);
}

void MixedSampler::improved(const std::vector<Eigen::Vector2d>& path, double length) {
  if (guided_ && guided_->improved(path, length) && std::isfinite(length)) {
    uniform_.inform(path.front(), path.back(), length);
  }
}

}  // namespace lrrt
