// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "lrrt/predict/encoder.hpp"
#include "lrrt/predict/region_predictor.hpp"

namespace lrrt {

/// What an ONNX file says about the model in it; written by the training package's export.
struct ModelInfo {
  std::filesystem::path path;
  std::string name;
  InputSpec input{};
  std::vector<std::string> classes;  ///< names in output order; one of them is "promising"
  std::size_t promising = 0;         ///< index of the promising class
  float threshold = 0.5F;            ///< a pixel is promising from this probability on
  std::string training_data;
  std::string training_budget;
  std::string commit;           ///< of the training code
  std::string runtime_version;  ///< of the ONNX Runtime in use
};

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
class OnnxPredictor final : public RegionPredictor {
 public:
  /// @throws ModelError when the runtime or the file cannot be loaded or the metadata do not fit.
  /// @throws RequestError when the number of threads is out of range.
  explicit OnnxPredictor(const std::filesystem::path& model = default_model_path(), OnnxOptions options = {});
  ~OnnxPredictor() override;
  OnnxPredictor(OnnxPredictor&&) noexcept;
  OnnxPredictor& operator=(OnnxPredictor&&) noexcept;

  const ModelInfo& info() const;
  Prediction predict(const OccupancyMap& map, const Eigen::Vector2d& start, const Eigen::Vector2d& goal) const override;

 private:
  class Session;
  std::unique_ptr<Session> session_;
};

}  // namespace lrrt
