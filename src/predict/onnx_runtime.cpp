// SPDX-License-Identifier: BSD-3-Clause
#include "onnx_runtime.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <vector>

#include "lrrt/error.hpp"
#include "own_path.hpp"

namespace lrrt {
namespace {

/// The oldest API that has all the calls in use; every newer runtime still offers it.
constexpr std::uint32_t oldest_api = 21;

std::vector<std::string> candidates() {
  std::vector<std::string> places;
  if (const char* chosen = std::getenv("LRRT_ONNXRUNTIME"); chosen != nullptr && *chosen != '\0') return {chosen};
  // in the wheel; from liblrrt.so; from a program in bin
  for (const auto& place : around_own_path({"", "lrrt", LRRT_RUNTIME_FROM_PROGRAM}, "libonnxruntime.so.1"))
    places.push_back(place.string());
#ifdef LRRT_DEFAULT_ONNXRUNTIME
  places.emplace_back(LRRT_DEFAULT_ONNXRUNTIME);
#endif
  places.emplace_back("libonnxruntime.so.1");
  places.emplace_back("libonnxruntime.so");
  return places;
}

/// The API of one library, or null with the reason appended to `failures`.
const OrtApi* open(const std::string& place, std::string& version, std::string& failures) {
  void* library = dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    failures += "\n  " + place + ": " + dlerror();
    return nullptr;
  }
  const auto get_base = reinterpret_cast<const OrtApiBase* (*)()>(dlsym(library, "OrtGetApiBase"));
  const OrtApiBase* base = get_base != nullptr ? get_base() : nullptr;
  const OrtApi* api = base != nullptr ? base->GetApi(oldest_api) : nullptr;
  if (api == nullptr) {
    failures += "\n  " + place + ": " +
                (base != nullptr ? std::string("version ") + base->GetVersionString() + " is older than 1." +
                                       std::to_string(oldest_api)
                                 : std::string("is not ONNX Runtime"));
    dlclose(library);
    return nullptr;
  }
  version = base->GetVersionString();
  return api;
}

std::string open_first() {
  std::string failures;
  std::string version;
  for (const std::string& place : candidates()) {
    if (const OrtApi* api = open(place, version, failures)) {
      Ort::InitApi(api);
      return version;
    }
  }
  throw ModelError(
      "ONNX Runtime (1." + std::to_string(oldest_api) +
      " or newer) cannot be opened. Set LRRT_ONNXRUNTIME to the path of libonnxruntime.so, or install it where "
      "the dynamic linker finds it. Tried:" +
      failures);
}

}  // namespace

const std::string& open_onnx_runtime() {
  static const std::string version = open_first();  // a throwing initialiser is tried again by the next call
  return version;
}

}  // namespace lrrt
