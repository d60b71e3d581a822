// SPDX-License-Identifier: BSD-3-Clause
#include "outputs.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <system_error>

#include "result_file.hpp"

namespace lrrt::bench {
namespace {

namespace fs = std::filesystem;

/// What a link leads to, also where that is not there yet.
fs::path followed(fs::path path) {
  constexpr int most_links = 40;
  std::error_code error;
  for (int links = 0; links < most_links && fs::is_symlink(path, error); ++links) {
    path = path.parent_path() / fs::read_symlink(path, error);
  }
  return path;
}

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  const fs::path whole = fs::weakly_canonical(fs::absolute(a, error), error);
  return !error && whole == fs::weakly_canonical(fs::absolute(b, error), error);
}

/// A device, a pipe, or the file into which standard output goes: nothing may take its place.
bool written_as_it_is(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status) || fs::is_directory(status)) return false;
  return !fs::is_regular_file(status) || fs::equivalent(path, "/dev/stdout", error);
}

bool put(const fs::path& path, const std::string& text, std::ios::openmode mode) {
  std::ofstream file(path, std::ios::binary | mode);
  file << text;
  file.close();
  return !file.fail();
}

/// The files that a run makes for an output, those that are gone at its end among them.
std::vector<fs::path> made_for(const Output& output) {
  const fs::path target = followed(output.path);
  std::vector<fs::path> files{target, with_suffix(target, ".new")};
  if (!output.resumable) return files;
  const fs::path part = with_suffix(output.path, ".part");
  files.insert(files.end(), {part, with_suffix(part, ".new")});
  return files;
}

[[noreturn]] void refuse(const Output& output, const std::string& problem) {
  throw ResultError(output.option + " " + output.path.string() + ": " + problem);
}

void check_place(const Output& output) {
  std::error_code error;
  if (output.path.empty()) refuse(output, "names no file; is a variable of the shell not set?");
  if (output.path.filename().empty() || fs::is_directory(output.path, error)) {
    refuse(output, "is a folder; expected the name of a file");
  }
  const bool as_it_is = written_as_it_is(output.path);
  if (as_it_is && output.resumable) {
    refuse(output, "is no regular file; rows are kept beside it, so expected a file in a folder");
  }
  const bool closed = fs::exists(output.path, error) && access(output.path.c_str(), W_OK) != 0;
  const std::vector<fs::path> files = made_for(output);
  const bool possible = as_it_is || std::all_of(files.begin() + 1, files.end(), can_make);
  if (closed || !possible)
    refuse(output, "cannot be written; expected a file in a folder that exists and may be written");
}

bool meet(const std::vector<fs::path>& ours, const std::vector<fs::path>& others) {
  return std::any_of(ours.begin(), ours.end(), [&](const fs::path& a) {
    return std::any_of(others.begin(), others.end(), [&](const fs::path& b) { return same_file(a, b); });
  });
}

}  // namespace

void check_outputs(const std::vector<Output>& outputs, const std::vector<Input>& inputs) {
  std::vector<const Output*> before;
  for (const Output& output : outputs) {
    check_place(output);
    if (written_as_it_is(output.path)) continue;
    const std::vector<fs::path> files = made_for(output);
    for (const Input& input : inputs) {
      if (meet(files, {input.path})) refuse(output, "would overwrite " + input.what + "; expected a file of its own");
    }
    for (const Output* other : before) {
      if (meet(files, made_for(*other))) {
        refuse(output, "would overwrite what " + other->option + " writes; expected a file of its own");
      }
    }
    before.push_back(&output);
  }
}

bool can_make(const fs::path& path) {
  std::error_code error;
  if (fs::exists(path, error)) return fs::is_regular_file(path, error) && access(path.c_str(), W_OK) == 0;
  const bool made = std::ofstream(path).is_open();
  if (made) drop(path);
  return made;
}

void write_file(const fs::path& path, const std::string& text) {
  if (written_as_it_is(path)) {
    if (!put(path, text, std::ios::app)) cannot_write(path);
    return;
  }
  const fs::path target = followed(path);
  const fs::path fresh = with_suffix(target, ".new");
  std::error_code error;
  bool written = put(fresh, text, std::ios::trunc);
  if (written) {
    fs::rename(fresh, target, error);
    written = !error;
  }
  if (written) return;
  drop(fresh);
  cannot_write(path);
}

fs::path with_suffix(fs::path path, const char* suffix) {
  path += suffix;
  return path;
}

void drop(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_regular_file(fs::symlink_status(path, ignored))) fs::remove(path, ignored);
}

void cannot_write(const fs::path& path) {
  throw ResultError(path.string() + ": cannot be written; expected a folder that exists, may be written and has room");
}

}  // namespace lrrt::bench
