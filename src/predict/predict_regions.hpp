// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "lrrt/predict/encoder.hpp"
#include "lrrt/predict/model_info.hpp"
#include "lrrt/predict/region_predictor.hpp"

namespace lrrt {

/// Most pictures that a network is given at once, and most pixels in them, where there are several. On two cores eight
/// take a fifth less time than one by one, sixteen hardly less; a picture of a million pixels keeps them busy by
/// itself.
inline constexpr std::size_t most_pictures = 8;
inline constexpr std::size_t most_pixels = most_pictures * 256 * 256;

/// Pictures of one side that wait for the network, one behind the other.
struct PictureBatch {
  /// What belongs to one picture.
  struct Entry {
    std::size_t query;  ///< its number
    InputFit fit;
    PredictTimings timings;
  };

  std::vector<std::uint8_t> images;  ///< never shrinks: the next call needs as much
  std::vector<Entry> entries;
};

/// The batches of a call, by side.
using PictureBatches = std::map<int, PictureBatch>;

/// A network, whatever runs it.
struct Network {
  /// Runs `count` pictures of one side. @return the output, picture by picture, class by class; valid until the next
  /// run.
  using Run = std::function<const float*(std::vector<std::uint8_t>& images, std::size_t count, int side)>;

  const ModelInfo& info;
  const Encoder& encoder;
  bool one_by_one;  ///< it takes a single picture at a time
  Run run;
};

/// The predictions of queries on one map, in their order: encodes them, runs the network on pictures of the same side
/// together, brings its output back to the map.
/// @param batches empty, or left over from an earlier call that came to its end.
/// @throws RequestError when a start or a goal is not on a free pixel; the text does not say of which query.
std::vector<Prediction> predict_regions(const Network& network, const OccupancyMap& map,
                                        const std::vector<RegionQuery>& queries, PictureBatches& batches);

/// @throws RequestError that names the first query whose start or goal is not on a free pixel.
void check_queries(const OccupancyMap& map, const std::vector<RegionQuery>& queries);

}  // namespace lrrt
