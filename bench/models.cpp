// SPDX-License-Identifier: BSD-3-Clause
#include "models.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>

#include "lrrt/predict/onnx_predictor.hpp"

namespace lrrt::bench {
namespace fs = std::filesystem;

fs::path model_path(const Suite& suite, const std::string& model) {
  return model == "default" ? default_model_path() : suite.resolved(model);
}

std::vector<std::string> matching_models(const Suite& suite, const std::string& pattern) {
  if (pattern.find_first_of("*?[") == std::string::npos) return {pattern};
  const fs::path written(pattern);
  const fs::path folder = suite.resolved(written.parent_path().string());
  std::vector<std::string> result;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (fnmatch(written.filename().c_str(), name.c_str(), 0) == 0) {
      result.push_back((written.parent_path() / name).string());
    }
  }
  if (result.empty()) throw SuiteError("models: no file matches " + (folder / written.filename()).string());
  std::sort(result.begin(), result.end());
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
