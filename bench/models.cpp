// SPDX-License-Identifier: BSD-3-Clause
#include "models.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>

#ifdef LRRT_WITH_TORCH
#include "lrrt/predict/torch_predictor.hpp"
#endif

namespace lrrt::bench {
namespace fs = std::filesystem;

namespace {

#ifdef LRRT_WITH_TORCH
constexpr bool with_torch = true;

LoadedModel load_torchscript(const fs::path& file, int threads) {
  auto predictor = std::make_shared<const TorchScriptPredictor>(file, TorchOptions{threads});
  ModelInfo info = predictor->info();
  return {std::move(predictor), std::move(info)};
}
#else
constexpr bool with_torch = false;

LoadedModel load_torchscript(const fs::path& file, int /*threads*/) {
  throw SuiteError("models: " + file.string() +
                   " is a TorchScript archive, and this lrrt_bench was built without libtorch: build it with "
                   "-DLRRT_WITH_TORCH=ON (cmake --preset torch; Debian: libtorch-dev), or name ONNX files");
}
#endif

}  // namespace

bool is_torchscript(const fs::path& file) {
  return file.extension() == ".pt";
}

LoadedModel load_model(const fs::path& file, const OnnxOptions& options) {
  if (is_torchscript(file)) return load_torchscript(file, options.threads);
  auto predictor = std::make_shared<const OnnxPredictor>(file, options);
  ModelInfo info = predictor->info();
  return {std::move(predictor), std::move(info)};
}

fs::path model_path(const Suite& suite, const std::string& model) {
  return model == "default" ? default_model_path() : suite.resolved(model);
}

MatchingModels matching_models(const Suite& suite, const std::string& pattern) {
  if (pattern.find_first_of("*?[") == std::string::npos) return {{pattern}, {}};
  const fs::path written(pattern);
  const fs::path folder = suite.resolved(written.parent_path().string());
  MatchingModels result;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    const bool runs = entry.path().extension() == ".onnx" || (with_torch && is_torchscript(name));
    if ((!runs && !is_torchscript(name)) || fnmatch(written.filename().c_str(), name.c_str(), 0) != 0) continue;
    (runs ? result.found : result.left_out).push_back((written.parent_path() / name).string());
  }
  if (result.found.empty()) {
    throw SuiteError("models: no file that this lrrt_bench can run matches " + (folder / written.filename()).string() +
                     (with_torch ? ": expected files that end in .onnx or .pt"
                                 : ": expected files that end in .onnx; TorchScript (.pt) needs a build with "
                                   "-DLRRT_WITH_TORCH=ON"));
  }
  for (std::vector<std::string>* names : {&result.found, &result.left_out}) std::sort(names->begin(), names->end());
  return result;
}

std::string checksum_of(const std::string& bytes) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3ULL;
  constexpr const char* digits = "0123456789abcdef";
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4) text += digits[(hash >> shift) & 0xFU];
  return text;
}

std::string file_checksum(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw SuiteError(path.string() + ": cannot be read");
  return checksum_of({std::istreambuf_iterator<char>(file), {}});
}

}  // namespace lrrt::bench
