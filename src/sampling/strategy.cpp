// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/sampling/strategy.hpp"

#include <string>
#include <utility>

#include "lrrt/error.hpp"

namespace lrrt {

Eigen::Vector2d UniformStrategy::draw(Random& random) const {
  const double x = random.uniform(0.0, width_);
  return {x, random.uniform(0.0, height_)};
}

RegionStrategy::RegionStrategy(const PromisingRegion& region) : bridge_(region.bridge()) {
  if (region.area() == 0) {
    throw RequestError(
        "the promising region is empty: there is nothing to draw from; use the uniform strategy instead");
  }
  pixels_.reserve(region.area());
  for (int r = 0; r < region.height(); ++r) {
    for (int c = 0; c < region.width(); ++c) {
      const auto i =
          static_cast<std::size_t>(r) * static_cast<std::size_t>(region.width()) + static_cast<std::size_t>(c);
      if (region.mask()[i] != 0) pixels_.push_back({c, r});
    }
  }
}

Eigen::Vector2d RegionStrategy::draw(Random& random) const {
  const bool from_bridge = !bridge_.empty() && random.uniform() < 0.5;
  const std::vector<Pixel>& pixels = from_bridge ? bridge_ : pixels_;
  const Pixel pixel = pixels[random.index(pixels.size())];
  const double x = pixel.c + random.uniform();
  return {x, pixel.r + random.uniform()};
}

MixedSampler::MixedSampler(std::unique_ptr<SamplingStrategy> guided, UniformStrategy uniform, double alpha,
                           std::uint64_t seed)
    : guided_(std::move(guided)), uniform_(std::move(uniform)), alpha_(alpha), random_(seed) {
  if (!(alpha >= 0.0 && alpha <= 1.0)) {
    throw RequestError("alpha " + std::to_string(alpha) + ": expected a share of guided samples from 0 to 1");
  }
}

Eigen::Vector2d MixedSampler::draw() {
  if (guided_ && random_.uniform() < alpha_) {
    ++counts_.guided;
    return guided_->draw(random_);
  }
  ++counts_.uniform;
  return uniform_.draw(random_);
}

}  // namespace lrrt
