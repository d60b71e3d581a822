// SPDX-License-Identifier: BSD-3-Clause
#include "input_output.hpp"

#include <algorithm>
#include <sstream>

#include "lrrt/error.hpp"

namespace lrrt {

void check_model_file(const std::filesystem::path& path, const char* kind) {
  std::error_code ignored;  // a path that the system cannot even look up is no file either
  if (!std::filesystem::is_regular_file(path, ignored)) {
    throw ModelError("model " + path.string() + " does not exist or is not a file: name " + kind +
                     " exported by the training package");
  }
}

void check_threads(int threads) {
  if (threads < 0 || threads > 1024) {
    throw RequestError("threads is " + std::to_string(threads) + ": expected 0 (choose) to 1024");
  }
}

std::string shape_text(const std::vector<std::int64_t>& shape) {
  std::string text = "[";
  for (const std::int64_t side : shape) text += (text.size() > 1 ? ", " : "") + std::to_string(side);
  return text + "]";
}

void check_probabilities(const ModelInfo& info, const float* values, std::size_t count) {
  constexpr float slack = 1e-3F;
  const auto fits = [](float p) { return p >= -slack && p <= 1.0F + slack; };  // false for what is not a number
  if (static_cast<std::size_t>(std::count_if(values, values + count, fits)) == count) return;
  std::ostringstream text;
  text << "model " << info.path.string() << " returned " << *std::find_if_not(values, values + count, fits)
       << " for the class 'promising', expected probabilities from 0 to 1. Was it trained to the end, and does its "
          "graph "
          "end in a softmax or a sigmoid?";
  throw ModelError(text.str());
}

}  // namespace lrrt
