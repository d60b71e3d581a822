// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <cstdlib>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace {

/// Arrays below 32 MiB stay in the process when they are freed. By default glibc gives most of them back to the system
/// until a larger one has been freed, so that a benchmark's time would hang on which others ran before it: new pages
/// cost as much as the distance field of a small map.
void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return EXIT_FAILURE;
  benchmark::RunSpecifiedBenchmarks();
  return EXIT_SUCCESS;
}
