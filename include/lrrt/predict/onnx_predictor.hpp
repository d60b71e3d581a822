// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>

#include "lrrt/predict/model_info.hpp"
#include "lrrt/predict/region_predictor.hpp"

namespace lrrt {

/// How ONNX Runtime runs the model.
struct OnnxOptions {
  int threads = 0;        ///< threads of one prediction; 0: two, or one on a single core
  bool spinning = false;  ///< idle threads spin between calls: faster in a tight loop, burns cores otherwise
};

/// Path of the model that ships with the library: $LRRT_MODEL, else the installed one, else the one in the source tree.
/// @throws ModelError when there is none.
std::filesystem::path default_model_path();

/// A region predictor that runs an ONNX model in ONNX Runtime.
///
/// The runtime is opened when the first model is loaded: $LRRT_ONNXRUNTIME, else the library beside this one, else
/// the one that was found at build time, else the system's. The session and its buffers are made once and reused; any
/// number of threads may predict with one object.
///
/// predict_many() runs up to eight pictures of one side at once, fewer where a side is above 256 pixels, and one by one
/// where the graph's batch axis is 1.
class OnnxPredictor final : public RegionPredictor {
 public:
  /// @throws ModelError when the runtime or the file cannot be loaded or the metadata do not fit.
  /// @throws RequestError when the number of threads is out of range.
  explicit OnnxPredictor(const std::filesystem::path& model = default_model_path(), OnnxOptions options = {});
  ~OnnxPredictor() override;
  /// A predictor that was moved from may only be assigned to or destroyed.
  OnnxPredictor(OnnxPredictor&&) noexcept;
  /// As the constructor.
  OnnxPredictor& operator=(OnnxPredictor&&) noexcept;

  /// What the model file says of itself.
  const ModelInfo& info() const;
  Prediction predict(const OccupancyMap& map, const Eigen::Vector2d& start, const Eigen::Vector2d& goal) const override;
  std::vector<Prediction> predict_many(const OccupancyMap& map, const std::vector<RegionQuery>& queries) const override;
  /// Four pixels of a map for every pixel of the picture: what is finer does not show.
  int detail() const override { return 4 * info().input.size; }

 private:
  class Session;
  std::unique_ptr<Session> session_;
};

}  // namespace lrrt
