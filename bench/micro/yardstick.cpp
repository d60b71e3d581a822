// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

// Work that no change to the library touches. A machine that is slower today is slower at this too, so times of two
// builds compare best as multiples of a yardstick of the same run.
namespace lrrt::micro {
namespace {

void arithmetic(benchmark::State& state) {
  std::mt19937_64 engine(1);
  for ([[maybe_unused]] auto _ : state) {
    for (int i = 0; i < 1000; ++i) benchmark::DoNotOptimize(engine());
  }
}

/// A copy that does not fit into a core's own caches.
void memory(benchmark::State& state) {
  constexpr std::size_t bytes = std::size_t{1} << 24U;
  const std::vector<std::uint8_t> from(bytes, 1);
  std::vector<std::uint8_t> to(bytes, 0);
  for ([[maybe_unused]] auto _ : state) {
    std::copy(from.begin(), from.end(), to.begin());
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes));
}

BENCHMARK(arithmetic)->Name("yardstick/arithmetic")->Unit(benchmark::kMicrosecond);
BENCHMARK(memory)->Name("yardstick/memory")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace lrrt::micro
