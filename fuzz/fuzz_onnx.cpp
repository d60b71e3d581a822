// SPDX-License-Identifier: BSD-3-Clause
/// Input: an ONNX file. It is loaded, and where that works it predicts.
#include "lrrt/predict/onnx_predictor.hpp"
#include "support.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lrrt;
  static const fuzz::Folder folder;
  const auto file = folder.write("model.onnx", fuzz::text_of(data, size));
  fuzz::answer_or_typed_error([&] {
    const OnnxPredictor predictor(file, {1, false});
    if (predictor.info().input.size > 64) return;  // fine, but slow
    const OccupancyMap map(6, 4, std::vector<Cell>(24, Cell::free));
    const PromisingRegion region = predictor.predict(map, {0.5, 0.5}, {5.5, 3.5}).region;
    for (const float p : region.probability()) fuzz::require(p >= -0.1F && p <= 1.1F, "probabilities are from 0 to 1");
  });
  return 0;
}
