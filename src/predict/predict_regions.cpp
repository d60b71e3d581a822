// SPDX-License-Identifier: BSD-3-Clause
#include "predict_regions.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "free_pixel.hpp"
#include "input_output.hpp"
#include "lrrt/stopwatch.hpp"
#include "number_of_query.hpp"

namespace lrrt {
namespace {

/// Below this probability a pixel never joins a region, whatever it would link.
constexpr float lowest_probability = 0.02F;

/// Half the width of a link, pixels of the network's input.
constexpr double link_halo = 3.0;

/// The predictions of one call, by the number of the query; those that are still missing are empty.
using Found = std::vector<std::optional<Prediction>>;

std::size_t most_at_once(const Network& network, int side) {
  if (network.one_by_one) return 1;
  return std::clamp<std::size_t>(most_pixels / plane_size(side), 1, most_pictures);
}

/// Adds a query's picture to the batch of its side. @return that side.
int encode(const Network& network, const OccupancyMap& map, const RegionQuery& query, std::size_t number,
           PictureBatches& batches) {
  Stopwatch watch;
  PictureBatch* batch = nullptr;
  const InputFit fit = network.encoder.encode(map, query.start, query.goal, [&](int side) {
    batch = &batches[side];
    const std::size_t picture = 3 * plane_size(side);
    const std::size_t offset = batch->entries.size() * picture;
    if (batch->images.size() < offset + picture) batch->images.resize(offset + picture);
    return batch->images.data() + offset;
  });
  PredictTimings timings;
  timings.encode = watch.lap_ms();
  batch->entries.push_back({number, fit, timings});
  return fit.size;
}

/// @param plane the network's output for the promising class, fit.size² values.
PromisingRegion region_of(const OccupancyMap& map, const RegionQuery& query, const InputFit& fit, const float* plane,
                          float threshold) {
  const Pixel start = OccupancyMap::pixel_of(map.to_pixel(query.start));
  const Pixel goal = OccupancyMap::pixel_of(map.to_pixel(query.goal));
  PromisingRegion region(map, fit.to_map(plane), start, goal, threshold);
  if (!region.connected()) {
    region = region.linked(map, start, goal, lowest_probability, static_cast<int>(link_halo / fit.scale));
  }
  region.drop_loose_parts(start);
  return region;
}

/// Runs the network on a batch and empties it.
void infer(const Network& network, const OccupancyMap& map, const std::vector<RegionQuery>& queries, int side,
           PictureBatch& batch, Found& found) {
  Stopwatch watch;
  const float* output = network.run(batch.images, batch.entries.size(), side);
  const double share = watch.lap_ms() / static_cast<double>(batch.entries.size());
  const std::size_t plane = plane_size(side);
  const float* promising = output + network.info.promising * plane;
  for (PictureBatch::Entry& entry : batch.entries) {
    check_probabilities(network.info, promising, plane);
    PromisingRegion region = region_of(map, queries[entry.query], entry.fit, promising, network.info.threshold);
    entry.timings.infer = share;
    entry.timings.region = watch.lap_ms();
    found[entry.query] = Prediction{std::move(region), entry.timings, side};
    promising += network.info.classes.size() * plane;
  }
  batch.entries.clear();
}

}  // namespace

std::vector<Prediction> predict_regions(const Network& network, const OccupancyMap& map,
                                        const std::vector<RegionQuery>& queries, PictureBatches& batches) {
  Found found(queries.size());
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const int side = encode(network, map, queries[i], i, batches);
    PictureBatch& batch = batches.at(side);
    if (batch.entries.size() == most_at_once(network, side)) infer(network, map, queries, side, batch, found);
  }
  for (auto& [side, batch] : batches) {
    if (!batch.entries.empty()) infer(network, map, queries, side, batch, found);
  }
  std::vector<Prediction> predictions;
  predictions.reserve(found.size());
  for (std::optional<Prediction>& prediction : found) predictions.push_back(std::move(*prediction));
  return predictions;
}

void check_queries(const OccupancyMap& map, const std::vector<RegionQuery>& queries) {
  for (std::size_t i = 0; i < queries.size(); ++i) {
    naming_query(i, [&] {
      free_pixel(map, queries[i].start, "start");
      free_pixel(map, queries[i].goal, "goal");
    });
  }
}

}  // namespace lrrt
