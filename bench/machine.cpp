// SPDX-License-Identifier: BSD-3-Clause
#include "machine.hpp"

#include <ompl/config.h>
#include <sys/utsname.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <thread>

#include "lrrt/version.hpp"

namespace lrrt::bench {
namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string compiler() {
#if defined(__clang__)
  return std::string("clang ") + __clang_version__;
#else
  return std::string("gcc ") + __VERSION__;
#endif
}

/// Debian leaves the macro that holds all of it empty.
std::string ompl_version() {
  return std::to_string(OMPL_MAJOR_VERSION) + "." + std::to_string(OMPL_MINOR_VERSION) + "." +
         std::to_string(OMPL_PATCH_VERSION);
}

}  // namespace

Json versions(const std::string& onnxruntime, const std::string& libtorch) {
  Json json = {{"lrrt", version}, {"ompl", ompl_version()}};
  if (!onnxruntime.empty()) json["onnxruntime"] = onnxruntime;
  if (!libtorch.empty()) json["libtorch"] = libtorch;
  json["compiler"] = compiler();
  json["build"] = LRRT_BENCH_BUILD;
  return json;
}

Json machine() {
  utsname system{};
  Json json = {{"processor", processor()}, {"cores", std::thread::hardware_concurrency()}};
  if (uname(&system) == 0) {
    json["system"] = std::string(system.sysname) + " " + system.release + " " + system.machine;
  }
  return json;
}

std::string now() {
  const std::time_t time = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&time, &parts);
  std::ostringstream text;
  text << std::put_time(&parts, "%Y-%m-%d %H:%M:%S");
  return text.str();
}

double load_average() {
  double load = -1.0;
  return getloadavg(&load, 1) == 1 ? load : -1.0;
}

}  // namespace lrrt::bench
