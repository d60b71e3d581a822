// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lrrt/predict/encoder.hpp"

namespace lrrt {

/// What a model file says about the model in it; written by the training package's export.
struct ModelInfo {
  std::filesystem::path path;        ///< the model file
  std::string name;                  ///< of the model
  InputSpec input{};                 ///< what the network expects of its picture
  std::vector<std::string> classes;  ///< names in output order; one of them is "promising"
  std::size_t promising = 0;         ///< index of the promising class
  float threshold = 0.5F;            ///< a pixel is promising from this probability on
  std::string training_data;         ///< in words
  std::string training_budget;       ///< in words
  std::string commit;                ///< of the training code
  std::string runtime_version;       ///< of the ONNX Runtime or the libtorch in use
};

}  // namespace lrrt
