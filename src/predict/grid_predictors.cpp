// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/predict/grid_predictors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

#include "free_pixel.hpp"
#include "lrrt/error.hpp"
#include "lrrt/map/distance_field.hpp"
#include "lrrt/map/shortest_path.hpp"
#include "lrrt/stopwatch.hpp"

namespace lrrt {
namespace {

void check_length(const char* name, double value) {
  if (value >= 0.0 && std::isfinite(value)) return;
  std::ostringstream text;
  text << name << " of " << value << " pixels: expected a finite number, 0 or more";
  throw RequestError(text.str());
}

std::string size_of(int width, int height) {
  return std::to_string(width) + "×" + std::to_string(height);
}

std::vector<Eigen::Vector2d> centres(const std::vector<Pixel>& pixels) {
  std::vector<Eigen::Vector2d> points;
  points.reserve(pixels.size());
  for (const Pixel p : pixels) points.emplace_back(p.c + 0.5, p.r + 0.5);
  return points;
}

Prediction around(const OccupancyMap& map, const std::vector<std::vector<Eigen::Vector2d>>& ways, double radius,
                  Pixel start, Pixel goal, PredictTimings timings) {
  const Stopwatch watch;
  std::vector<float> probability(map.size(), 0.0F);
  for (const auto& way : ways) {
    const std::vector<std::uint8_t> mask = widened(map, way, radius);
    std::transform(mask.begin(), mask.end(), probability.begin(), probability.begin(),
                   [](std::uint8_t in, float p) { return in != 0 ? 1.0F : p; });
  }
  PromisingRegion region(map, std::move(probability), start, goal);
  timings.region = watch.total_ms();
  return {std::move(region), timings};
}

/// Downhill over the pixels from one end until no neighbour is lower.
std::vector<Pixel> descend(const OccupancyMap& map, const DistanceField& field, Pixel from, Pixel to, double reach) {
  const auto potential = [&](Pixel p) {
    const double pull = std::hypot(p.c - to.c, p.r - to.r);
    const double lack = std::max(0.0, 1.0 - field.at(p) / std::max(reach, 1e-9));
    return pull + reach * lack * lack;
  };
  std::vector<Pixel> way{from};
  for (double lowest = potential(from);;) {
    Pixel next = way.back();
    for (int dr = -1; dr <= 1; ++dr) {
      for (int dc = -1; dc <= 1; ++dc) {
        const Pixel p{way.back().c + dc, way.back().r + dr};
        if (!map.is_free(p) || !map.is_free({p.c, way.back().r}) || !map.is_free({way.back().c, p.r})) continue;
        if (potential(p) < lowest) {
          lowest = potential(p);
          next = p;
        }
      }
    }
    if (next == way.back()) return way;
    way.push_back(next);
  }
}

}  // namespace

GivenRegion::GivenRegion(int width, int height, std::vector<float> probability, float threshold)
    : width_(width), height_(height), probability_(std::move(probability)), threshold_(threshold) {
  if (width < 1 || height < 1 ||
      probability_.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    throw RequestError("a region of " + size_of(width, height) + " pixels needs a probability for each, got " +
                       std::to_string(probability_.size()));
  }
  for (std::size_t i = 0; i < probability_.size(); ++i) {
    if (probability_[i] >= 0.0F && probability_[i] <= 1.0F) continue;  // written so that a NaN fails
    const auto columns = static_cast<std::size_t>(width);
    throw RequestError("the probability of pixel (" + std::to_string(i % columns) + ", " + std::to_string(i / columns) +
                       ") is " + std::to_string(probability_[i]) + ": expected a number from 0 to 1");
  }
}

Prediction GivenRegion::predict(const OccupancyMap& map, const Eigen::Vector2d& start,
                                const Eigen::Vector2d& goal) const {
  if (map.width() != width_ || map.height() != height_) {
    throw RequestError("the given region has " + size_of(width_, height_) + " pixels, the map " +
                       size_of(map.width(), map.height()) + ": expected the same size");
  }
  const Stopwatch watch;
  PromisingRegion region(map, probability_, free_pixel(map, start, "start"), free_pixel(map, goal, "goal"), threshold_);
  PredictTimings timings;
  timings.region = watch.total_ms();
  return {std::move(region), timings};
}

AStarPredictor::AStarPredictor(double radius) : radius_(radius) {
  check_length("radius", radius);
}

Prediction AStarPredictor::predict(const OccupancyMap& map, const Eigen::Vector2d& start,
                                   const Eigen::Vector2d& goal) const {
  const Pixel from = free_pixel(map, start, "start");
  const Pixel to = free_pixel(map, goal, "goal");
  const Stopwatch watch;
  const std::vector<Pixel> path = shortest_path(map, from, to);
  PredictTimings timings;
  timings.infer = watch.total_ms();
  return around(map, {centres(path)}, radius_, from, to, timings);
}

PotentialFieldPredictor::PotentialFieldPredictor(double radius, double reach) : radius_(radius), reach_(reach) {
  check_length("radius", radius);
  check_length("reach", reach);
}

Prediction PotentialFieldPredictor::predict(const OccupancyMap& map, const Eigen::Vector2d& start,
                                            const Eigen::Vector2d& goal) const {
  const Pixel from = free_pixel(map, start, "start");
  const Pixel to = free_pixel(map, goal, "goal");
  const Stopwatch watch;
  const DistanceField field(map);
  const std::vector<Pixel> forth = descend(map, field, from, to, reach_);
  const std::vector<Pixel> back = descend(map, field, to, from, reach_);
  PredictTimings timings;
  timings.infer = watch.total_ms();
  return around(map, {centres(forth), centres(back)}, radius_, from, to, timings);
}

}  // namespace lrrt
