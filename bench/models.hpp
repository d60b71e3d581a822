// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "suite.hpp"

namespace lrrt::bench {

/// The file of a model that a suite names: a path, or "default" for the one that ships.
std::filesystem::path model_path(const Suite& suite, const std::string& model);

/// The models that a suite's name or pattern ("models/*.onnx") stands for, sorted, in the suite's words.
/// @throws SuiteError when nothing matches.
std::vector<std::string> matching_models(const Suite& suite, const std::string& pattern);

/// A checksum (FNV-1a, 64 bits) that tells a changed file; no protection against a forged one.
std::string checksum_of(const std::string& bytes);
/// Of a file's bytes. @throws SuiteError when it cannot be read.
std::string file_checksum(const std::filesystem::path& path);

}  // namespace lrrt::bench
