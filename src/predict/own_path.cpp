// SPDX-License-Identifier: BSD-3-Clause
#include "own_path.hpp"

#include <dlfcn.h>

#include <cstring>

namespace lrrt {

std::filesystem::path own_path() {
  std::error_code failure;
  Dl_info info;
  const bool known = dladdr(reinterpret_cast<const void*>(&own_path), &info) != 0 && info.dli_fname != nullptr;
  if (known && std::strchr(info.dli_fname, '/') != nullptr) {
    std::filesystem::path found = std::filesystem::canonical(info.dli_fname, failure);
    if (!failure) return found;
  }
  // A program goes by the name that it was called by, found in PATH perhaps; the kernel knows its file.
  std::filesystem::path program = std::filesystem::canonical("/proc/self/exe", failure);
  return failure ? std::filesystem::path() : program;
}

std::vector<std::filesystem::path> around_own_path(std::initializer_list<const char*> folders,
                                                   const std::filesystem::path& file) {
  std::vector<std::filesystem::path> places;
  const std::filesystem::path own = own_path();
  if (own.empty()) return places;  // a relative path would be looked up in the folder that the user happens to be in
  for (const char* folder : folders) places.push_back((own.parent_path() / folder / file).lexically_normal());
  return places;
}

}  // namespace lrrt
