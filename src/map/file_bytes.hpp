// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include "lrrt/error.hpp"

namespace lrrt::detail {

/// Most bytes of a file that is read as a whole.
inline constexpr std::uintmax_t max_file_bytes = (std::uintmax_t{1} << 31) - 1;

/// Whole content of a regular file. @param most bytes that it may have.
/// @throws MapError that names the path when it is missing, no regular file, unreadable or larger.
inline std::string read_bytes(const std::filesystem::path& path, std::uintmax_t most = max_file_bytes) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    throw MapError(path.string() + ": no such file; expected a map; check the spelling and the working directory");
  }
  if (!std::filesystem::is_regular_file(status)) {  // a pipe would be waited for, a device never ends
    throw MapError(path.string() + ": not a regular file; expected a map file, not a folder, a device or a pipe");
  }
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!error && size > most) {
    throw MapError(path.string() + ": " + std::to_string(size) + " bytes are too many; expected at most " +
                   std::to_string(most) + "; is it the right file?");
  }
  std::ifstream stream(path, std::ios::binary);
  std::string bytes(error ? 0 : size, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  if (error || !stream.is_open() || stream.bad()) {
    throw MapError(path.string() + ": cannot be read; check that the file is readable for this user");
  }
  return bytes;
}

}  // namespace lrrt::detail
