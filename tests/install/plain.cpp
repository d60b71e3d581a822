// SPDX-License-Identifier: BSD-3-Clause
// plain: plans on a map made in memory, with liblrrt alone and without a model; the preprocessor knows the version.
#include <iostream>
#include <lrrt/planner.hpp>
#include <lrrt/version.hpp>
#include <string>
#include <vector>

#if LRRT_VERSION_MAJOR == 0 && LRRT_VERSION_MINOR < 1
#error "lrrt is older than 0.1"
#endif

int main() {
  const std::string numbers = std::to_string(LRRT_VERSION_MAJOR) + "." + std::to_string(LRRT_VERSION_MINOR) + "." +
                              std::to_string(LRRT_VERSION_PATCH);
  if (numbers != lrrt::version) {
    std::cerr << "failed: the macros say " << numbers << ", the constant " << lrrt::version << '\n';
    return 1;
  }
  lrrt::silence_ompl();
  lrrt::PlanOptions options;
  options.strategy = lrrt::Strategy::uniform;
  const lrrt::OccupancyMap map(40, 40, std::vector<lrrt::Cell>(1600, lrrt::Cell::free));
  const lrrt::PlanResult result = lrrt::Planner(nullptr, options).plan({map, {2.5, 2.5}, {37.5, 30.5}});
  std::cout << "lrrt " << numbers << ": " << lrrt::to_string(result.status) << '\n';
  return result.solved() ? 0 : 1;
}
