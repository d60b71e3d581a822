// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "lrrt/predict/model_info.hpp"

namespace lrrt {

/// Looks up one of a model's metadata by key.
using MetadataLookup = std::function<std::optional<std::string>(const std::string& key)>;

/// Reads and checks a model's metadata.
/// @throws ModelError that names the file and the key when one is missing or makes no sense.
ModelInfo read_model_info(const std::filesystem::path& path, const MetadataLookup& lookup);

}  // namespace lrrt
