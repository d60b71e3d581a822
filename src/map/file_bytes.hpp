// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include "lrrt/error.hpp"

namespace lrrt::detail {

/// Whole content of a regular file. @throws MapError that names the path when it is missing, a folder, or unreadable.
inline std::string read_bytes(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(status)) {
    throw MapError(path.string() + ": no such file; expected a map; check the spelling and the working directory");
  }
  if (!std::filesystem::is_regular_file(status)) {
    throw MapError(path.string() + ": not a regular file; expected a map file, not a folder or a device");
  }
  std::ifstream stream(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream.is_open() || stream.bad()) {
    throw MapError(path.string() + ": cannot be read; check that the file is readable for this user");
  }
  return bytes;
}

}  // namespace lrrt::detail
