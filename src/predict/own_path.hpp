// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <initializer_list>
#include <vector>

namespace lrrt {

/// Path of the shared library or program that this code was linked into; empty when the system cannot tell.
std::filesystem::path own_path();

/// Where `file` lies in each of `folders`, which count from the folder of own_path(); nothing when that is not known.
std::vector<std::filesystem::path> around_own_path(std::initializer_list<const char*> folders,
                                                   const std::filesystem::path& file);

}  // namespace lrrt
