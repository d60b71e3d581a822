// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "lrrt/predict/encoder.hpp"
#include "lrrt/predict/model_info.hpp"
#include "lrrt/predict/region_predictor.hpp"
#include "lrrt/stopwatch.hpp"

namespace lrrt {

/// @param kind what the file should be, for the text of the error.
/// @throws ModelError when there is no such file.
void check_model_file(const std::filesystem::path& path, const char* kind);

/// @throws RequestError when the number of threads is out of range.
void check_threads(int threads);

/// A tensor's shape for the text of an error, "[1, 3, 256, 256]".
std::string shape_text(const std::vector<std::int64_t>& shape);

/// Pixels of a square: of the network's input, and so of one class in its output.
inline std::size_t plane_size(int side) {
  return static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
}

/// What the calls under way work with: made when all are in use, kept for the next call.
template <typename Workspace>
class Pool {
 public:
  /// @param make returns a new workspace.
  template <typename Make>
  std::unique_ptr<Workspace> borrow(const Make& make) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!idle_.empty()) {
        std::unique_ptr<Workspace> workspace = std::move(idle_.back());
        idle_.pop_back();
        return workspace;
      }
    }
    return make();
  }

  void give_back(std::unique_ptr<Workspace> workspace) {
    const std::lock_guard<std::mutex> lock(mutex_);
    idle_.push_back(std::move(workspace));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Workspace>> idle_;
};

/// Below this probability a pixel never joins a region, whatever it would link.
inline constexpr float lowest_probability = 0.02F;

/// Half the width of a link, pixels of the network's input.
inline constexpr double link_halo = 3.0;

/// Arguments of RegionPredictor::predict.
struct RegionQuery {
  const OccupancyMap& map;
  const Eigen::Vector2d& start;
  const Eigen::Vector2d& goal;
};

/// One prediction, whatever runs the network: encodes the query, runs the network, brings its output back to the map.
/// @param image receives the picture. @param run runs the network on it, given its side, and returns its output, class
/// by class.
template <typename Run>
Prediction predict_region(const ModelInfo& info, const Encoder& encoder, const RegionQuery& query,
                          std::vector<std::uint8_t>& image, const Run& run) {
  PredictTimings timings;
  Stopwatch watch;
  const InputFit fit = encoder.encode(query.map, query.start, query.goal, image);
  timings.encode = watch.lap_ms();
  const float* output = run(fit.size);
  timings.infer = watch.lap_ms();
  const Pixel start = OccupancyMap::pixel_of(query.map.to_pixel(query.start));
  const Pixel goal = OccupancyMap::pixel_of(query.map.to_pixel(query.goal));
  PromisingRegion region(query.map, fit.to_map(output + info.promising * plane_size(fit.size)), start, goal,
                         info.threshold);
  if (!region.connected()) {
    region = region.linked(query.map, start, goal, lowest_probability, static_cast<int>(link_halo / fit.scale));
  }
  region.drop_loose_parts(start);
  timings.region = watch.lap_ms();
  return {std::move(region), timings};
}

}  // namespace lrrt
