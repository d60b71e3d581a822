// SPDX-License-Identifier: BSD-3-Clause
/// Input: metadata of a model, lines `key=value`.
#include <map>
#include <sstream>

#include "lrrt/predict/encoder.hpp"
#include "predict/model_info.hpp"
#include "support.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lrrt;
  std::map<std::string, std::string> metadata;
  std::istringstream lines(fuzz::text_of(data, size));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t equals = line.find('=');
    if (equals != std::string::npos) metadata[line.substr(0, equals)] = line.substr(equals + 1);
  }
  fuzz::answer_or_typed_error([&] {
    const ModelInfo info = read_model_info("fuzz.onnx", [&](const std::string& key) -> std::optional<std::string> {
      const auto found = metadata.find(key);
      return found != metadata.end() ? std::optional(found->second) : std::nullopt;
    });
    fuzz::require(info.promising < info.classes.size(), "the promising class is one of the classes");
    fuzz::require(info.threshold > 0.0F && info.threshold <= 1.0F, "the threshold is a probability");
    try {
      const Encoder encoder(info.input);
    } catch (const RequestError& error) {
      fuzz::require(false, error.what());  // what the metadata may say, the encoder can do
    }
  });
  return 0;
}
