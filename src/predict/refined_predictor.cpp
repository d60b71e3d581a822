// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/predict/refined_predictor.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "lrrt/error.hpp"
#include "lrrt/map/components.hpp"
#include "lrrt/region/geodesic.hpp"
#include "lrrt/stopwatch.hpp"

namespace lrrt {
namespace {

/// Probability from which on a pixel of the refined region is promising; the predictor's own threshold may differ.
constexpr float threshold = 0.5F;
constexpr float just_below = 0.49F;

/// The pixels of a shortest way inside a region, from start to goal.
std::vector<Pixel> way_inside(const PromisingRegion& region, Pixel start, Pixel goal) {
  const Geodesic to_goal(region.mask(), region.width(), region.height(), goal);
  std::vector<Pixel> way;
  for (Pixel at = start; to_goal.at(at) != Geodesic::unreached;) {
    way.push_back(at);
    const Pixel next = to_goal.step_towards_source(at);
    if (next == at) break;
    at = next;
  }
  return way;
}

/// A stretch of a way, and the part of the map around it.
struct Stretch {
  Pixel from;
  Pixel to;
  PixelBox part;
};

/// The part of a map of up to a window's size with a box in its middle.
PixelBox part_around(const PixelBox& box, int window, const OccupancyMap& map) {
  const auto along = [window](int first, int length, int side) {
    const int size = std::min(std::max(window, length), side);
    return std::pair(std::clamp(first + (length - size) / 2, 0, side - size), size);
  };
  const auto [c, width] = along(box.c, box.width, map.width());
  const auto [r, height] = along(box.r, box.height, map.height());
  return {c, r, width, height};
}

/// Cuts a way into stretches, each as long as it fits into a window with some room around it.
std::vector<Stretch> stretches_of(const std::vector<Pixel>& way, int window, const OccupancyMap& map) {
  const int most = window - window / 4;
  std::vector<Stretch> stretches;
  for (std::size_t first = 0; first + 1 < way.size();) {
    PixelBox box{way[first].c, way[first].r, 1, 1};
    std::size_t last = first;
    while (last + 1 < way.size()) {
      const PixelBox grown = united(box, {way[last + 1].c, way[last + 1].r, 1, 1});
      if (std::max(grown.width, grown.height) > most) break;
      box = grown;
      ++last;
    }
    stretches.push_back({way[first], way[last], part_around(box, window, map)});
    first = last;
  }
  return stretches;
}

/// Takes the region of a part into the probabilities of the whole map.
void take(const PromisingRegion& region, const PixelBox& part, const OccupancyMap& map,
          std::vector<float>& probability) {
  std::size_t i = 0;
  for (int r = part.r; r < part.r + part.height; ++r) {
    for (int c = part.c; c < part.c + part.width; ++c, ++i) {
      const float seen = region.mask()[i] != 0 ? std::max(region.probability()[i], threshold)
                                               : std::min(region.probability()[i], just_below);
      float& known = probability[map.index({c, r})];
      known = std::max(known, seen);  // NaN is never larger
    }
  }
}

}  // namespace

RefinedPredictor::RefinedPredictor(std::shared_ptr<const RegionPredictor> predictor, RefineOptions options)
    : predictor_(std::move(predictor)), options_(options) {
  if (!predictor_) throw RequestError("a refined predictor needs one that it refines");
  if (options_.window < 32 || options_.most_windows < 1) {
    throw RequestError("refining " + std::to_string(options_.most_windows) + " windows of " +
                       std::to_string(options_.window) + " pixels: expected at least one of at least 32");
  }
}

Prediction RefinedPredictor::predict(const OccupancyMap& map, const Eigen::Vector2d& start,
                                     const Eigen::Vector2d& goal) const {
  Prediction result = predictor_->predict(map, start, goal);
  if (std::max(map.width(), map.height()) <= options_.window) return result;
  Stopwatch watch;
  const Pixel from = OccupancyMap::pixel_of(map.to_pixel(start));
  const Pixel to = OccupancyMap::pixel_of(map.to_pixel(goal));
  const PromisingRegion whole = result.region.bridged(map, from, to);
  const std::vector<Stretch> stretches = stretches_of(way_inside(whole, from, to), options_.window, map);
  if (stretches.empty() || stretches.size() > static_cast<std::size_t>(options_.most_windows)) return result;

  result.timings.region += watch.lap_ms();
  std::vector<float> probability(map.size(), 0.0F);
  for (const Stretch& stretch : stretches) {
    const Prediction near =
        predictor_->predict(map.cropped(stretch.part), map.center(stretch.from), map.center(stretch.to));
    watch.lap_ms();
    take(near.region, stretch.part, map, probability);
    result.timings.encode += near.timings.encode;
    result.timings.infer += near.timings.infer;
    result.timings.region += near.timings.region + watch.lap_ms();
  }
  result.region = PromisingRegion(map, std::move(probability), from, to, threshold);
  result.timings.region += watch.lap_ms();
  return result;
}

}  // namespace lrrt
