// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The runtime is opened by hand, so that one binary runs with any version that is new enough (its symbols are
// versioned). The header keeps the runtime's table of functions in a static: under a namespace of our own, or another
// module of the process that uses the same header with another runtime would share it.
#define ORT_API_MANUAL_INIT
#define Ort lrrt_ort
#include <onnxruntime_cxx_api.h>
#undef ORT_API_MANUAL_INIT

#include <string>

namespace lrrt {

/// Opens ONNX Runtime on the first call, for the whole process. @return its version.
/// @throws ModelError that lists the places tried when none holds a usable library.
const std::string& open_onnx_runtime();

}  // namespace lrrt
