// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "lrrt/predict/model_info.hpp"

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

/// @param values of the promising class, `count` of them, as the network returned them.
/// @throws ModelError when one is not a number from 0 to 1, but for rounding.
void check_probabilities(const ModelInfo& info, const float* values, std::size_t count);

}  // namespace lrrt
