// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lrrt::bench {

/// A file that a run shall write.
struct Output {
  std::string option;          ///< that names it
  std::filesystem::path path;  ///< as it was given
  bool resumable = false;      ///< whether rows are kept beside it, in PATH.part, while the run goes on
};

/// A file that a run reads.
struct Input {
  std::string what;  ///< the option that names it, or what it is
  std::filesystem::path path;
};

/// Makes sure, before anything is measured, that every output can be written and that none takes the place of an input
/// or of another output. A device or a pipe may be named more than once.
/// @throws ResultError that names option and path.
void check_outputs(const std::vector<Output>& outputs, const std::vector<Input>& inputs);

/// Whether a file can be made in a folder that exists. Leaves nothing behind.
bool can_make(const std::filesystem::path& path);

/// Writes a file so that it appears complete or not at all. Where the path is a link, what it leads to is written; what
/// is there and no regular file, such as a device or a pipe, is written to as it is, and so is standard output.
/// @throws ResultError when it cannot be written.
void write_file(const std::filesystem::path& path, const std::string& text);

/// The path with more text at its end.
std::filesystem::path with_suffix(std::filesystem::path path, const char* suffix);

/// Removes a file that a failed run would leave behind; nothing else.
void drop(const std::filesystem::path& path);

/// @throws ResultError always.
[[noreturn]] void cannot_write(const std::filesystem::path& path);

}  // namespace lrrt::bench
