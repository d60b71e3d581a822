// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>

#include "lrrt/predict/model_info.hpp"
#include "lrrt/predict/region_predictor.hpp"

namespace lrrt {

/// How libtorch runs the model.
struct TorchOptions {
  /// Threads of one operation; 0: leave libtorch's setting alone. libtorch has one setting for the whole process: it
  /// holds for every other user of libtorch too, and the last predictor that sets it wins.
  int threads = 0;
};

/// A region predictor that runs a TorchScript archive in libtorch; there only where the library was built with
/// LRRT_WITH_TORCH.
///
/// The module and the buffers of its pictures are made once and reused; any number of threads may predict with one
/// object. An archive holds a program: load only files that you trust.
///
/// predict_many() runs up to eight pictures of one side at once, fewer where a side is above 256 pixels, and one by one
/// where the program fails on two, which is tried when it is loaded.
class TorchScriptPredictor final : public RegionPredictor {
 public:
  /// @param model an archive (.pt) that takes uint8 pictures, N × 3 × S × S (N may have to be 1), returns float32
  /// probabilities, N × K × S × S, and carries the metadata of the ONNX file in its extra file "metadata.json".
  /// @throws ModelError when the file cannot be loaded or run, or the metadata do not fit.
  /// @throws RequestError when the number of threads is out of range.
  explicit TorchScriptPredictor(const std::filesystem::path& model, TorchOptions options = {});
  ~TorchScriptPredictor() override;
  /// A predictor that was moved from may only be assigned to or destroyed.
  TorchScriptPredictor(TorchScriptPredictor&&) noexcept;
  /// As the constructor.
  TorchScriptPredictor& operator=(TorchScriptPredictor&&) noexcept;

  /// What the model file says of itself.
  const ModelInfo& info() const;
  Prediction predict(const OccupancyMap& map, const Eigen::Vector2d& start, const Eigen::Vector2d& goal) const override;
  std::vector<Prediction> predict_many(const OccupancyMap& map, const std::vector<RegionQuery>& queries) const override;
  /// Four pixels of a map for every pixel of the picture: what is finer does not show.
  int detail() const override { return 4 * info().input.size; }

 private:
  class Program;
  std::unique_ptr<Program> program_;
};

}  // namespace lrrt
