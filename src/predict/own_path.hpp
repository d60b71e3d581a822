// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace lrrt {

/// Path of the shared library or program that this code was linked into; empty when the system cannot tell.
std::filesystem::path own_path();

}  // namespace lrrt
