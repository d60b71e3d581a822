// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/region/promising_region.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "lrrt/error.hpp"
#include "lrrt/map/flood.hpp"

namespace lrrt {
namespace {

void check(const OccupancyMap& map, const std::vector<float>& probability, float threshold) {
  if (probability.size() != map.size()) {
    throw RequestError("a region over a map of " + std::to_string(map.width()) + "×" + std::to_string(map.height()) +
                       " pixels needs " + std::to_string(map.size()) + " probabilities, but " +
                       std::to_string(probability.size()) + " were given");
  }
  if (!(threshold > 0.0F && threshold <= 1.0F)) {
    throw RequestError("region threshold " + std::to_string(threshold) + ": expected more than 0 and at most 1");
  }
}

}  // namespace

PromisingRegion::PromisingRegion(const OccupancyMap& map, std::vector<float> probability, Pixel start, Pixel goal,
                                 float threshold)
    : width_(map.width()), height_(map.height()), coarseness_(map.coarseness()), probability_(std::move(probability)) {
  check(map, probability_, threshold);
  mask_.resize(probability_.size());
  // A comparison with NaN is false, so a broken probability never enters the mask.
  std::transform(probability_.begin(), probability_.end(), map.cells().begin(), mask_.begin(),
                 [&](float p, Cell cell) { return static_cast<std::uint8_t>(cell == Cell::free && p >= threshold); });
  area_ = static_cast<std::size_t>(std::count(mask_.begin(), mask_.end(), std::uint8_t{1}));
  connected_ = Flood(mask_, width_, height_, start).reached(goal);
}

void PromisingRegion::drop_loose_parts(Pixel start) {
  if (!connected_) return;
  mask_ = Flood(mask_, width_, height_, start).take();
  area_ = static_cast<std::size_t>(std::count(mask_.begin(), mask_.end(), std::uint8_t{1}));
}

void PromisingRegion::check_belongs_to(const OccupancyMap& map) const {
  if (map.width() == width_ && map.height() == height_) return;
  throw RequestError("a region of " + std::to_string(width_) + "×" + std::to_string(height_) +
                     " pixels does not belong to a map of " + std::to_string(map.width()) + "×" +
                     std::to_string(map.height()) + ": give the map it was predicted for");
}

}  // namespace lrrt
