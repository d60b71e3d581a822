// SPDX-License-Identifier: BSD-3-Clause
#include "own_path.hpp"

#include <dlfcn.h>

namespace lrrt {

std::filesystem::path own_path() {
  Dl_info info;
  if (dladdr(reinterpret_cast<const void*>(&own_path), &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code ignored;
  const std::filesystem::path found = std::filesystem::canonical(info.dli_fname, ignored);
  return ignored ? std::filesystem::path(info.dli_fname) : found;
}

}  // namespace lrrt
