// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "json.hpp"

namespace lrrt::bench {

/// Versions of what was measured: lrrt, OMPL, ONNX Runtime, libtorch, compiler, build type.
/// @param onnxruntime,libtorch as a loaded model tells it; empty where none was needed.
Json versions(const std::string& onnxruntime, const std::string& libtorch);

/// Where it was measured: processor, cores, system. Nothing that names the machine.
Json machine();

/// Date and time, UTC, as "2025-01-31 12:00:00".
std::string now();

/// Load of the machine over the last minute, in busy processes; below zero where the system does not tell.
double load_average();

}  // namespace lrrt::bench
