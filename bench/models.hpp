// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "lrrt/predict/onnx_predictor.hpp"
#include "suite.hpp"

namespace lrrt::bench {

/// The file of a model that a suite names: a path, or "default" for the one that ships.
std::filesystem::path model_path(const Suite& suite, const std::string& model);

/// Whether a file is a TorchScript archive, by its name (.pt). Any other model is an ONNX file.
bool is_torchscript(const std::filesystem::path& file);

/// What a suite's pattern ("models/*") stands for, sorted, in the suite's words.
struct MatchingModels {
  std::vector<std::string> found;     ///< this program can run them
  std::vector<std::string> left_out;  ///< TorchScript archives, where it was built without libtorch
};

/// The models that a pattern stands for, files of the folder that end in .onnx or .pt; or the one that a name names.
/// @throws SuiteError when no model that this program can run matches.
MatchingModels matching_models(const Suite& suite, const std::string& pattern);

/// A model made ready to predict, whatever runs it.
struct LoadedModel {
  std::shared_ptr<const RegionPredictor> predictor;
  ModelInfo info;
};

/// Loads a model. @param options of an ONNX file; a TorchScript archive takes the number of threads only.
/// @throws SuiteError when it is a TorchScript archive and this program was built without libtorch. @throws ModelError.
LoadedModel load_model(const std::filesystem::path& file, const OnnxOptions& options = {});

/// A checksum (FNV-1a, 64 bits) that tells a changed file; no protection against a forged one.
std::string checksum_of(const std::string& bytes);
/// Of a file's bytes. @throws SuiteError when it cannot be read.
std::string file_checksum(const std::filesystem::path& path);

}  // namespace lrrt::bench
