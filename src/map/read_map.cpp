// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/map/read_map.hpp"

#include <algorithm>
#include <fstream>
#include <string>
#include <system_error>

#include "lrrt/error.hpp"
#include "lrrt/map/map_server.hpp"
#include "lrrt/map/moving_ai.hpp"

namespace lrrt {
namespace {

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  const auto to_lower = [](char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  };
  std::transform(extension.begin(), extension.end(), extension.begin(), to_lower);
  return extension;
}

/// Nothing for what is no regular file: a pipe would be waited for.
std::string first_word(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return {};
  std::string word(5, '\0');
  std::ifstream stream(path, std::ios::binary);
  stream.read(word.data(), static_cast<std::streamsize>(word.size()));
  word.resize(static_cast<std::size_t>(stream.gcount()));
  return word.substr(0, word.find_first_of(" \t\r\n"));
}

}  // namespace

OccupancyMap read_map(const std::filesystem::path& path, const ImageDecoder& decode) {
  const std::string extension = lower_extension(path);
  if (extension == ".yaml" || extension == ".yml") return read_map_server(path, decode);
  if (extension == ".map" && first_word(path) == "type") return read_moving_ai_map(path);
  if (extension == ".scen") {
    throw MapError(path.string() + ": a scenario list is not a map; expected the .map file that it names");
  }
  return map_from_image(decode(path));
}

}  // namespace lrrt
