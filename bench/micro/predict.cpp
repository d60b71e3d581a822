// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <cstdint>
#include <map>
#include <vector>

#include "lrrt/error.hpp"
#include "lrrt/predict/encoder.hpp"
#include "lrrt/predict/onnx_predictor.hpp"
#include "scenes.hpp"

namespace lrrt::micro {
namespace {

void encode(benchmark::State& state, SceneMaker scene_of) {
  const Scene& scene = scene_of(side_of(state));
  const Eigen::Vector2d start = scene.map.center(scene.start);
  const Eigen::Vector2d goal = scene.map.center(scene.goal);
  const Encoder encoder;
  std::vector<std::uint8_t> image;
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(encoder.encode(scene.map, start, goal, image));
    benchmark::ClobberMemory();
  }
  count_pixels(state, scene.map);
}

/// The shipped model, loaded once for each number of threads. Its threads do not spin: the library's default.
const OnnxPredictor& model_with(int threads) {
  static std::map<int, OnnxPredictor> loaded;
  const auto found = loaded.find(threads);
  if (found != loaded.end()) return found->second;
  return loaded.emplace(threads, OnnxPredictor(default_model_path(), {threads, false})).first->second;
}

/// Whole predictions; the counters tell microseconds of each stage.
void measure(benchmark::State& state, const OnnxPredictor& predictor, const Scene& scene) {
  const Eigen::Vector2d start = scene.map.center(scene.start);
  const Eigen::Vector2d goal = scene.map.center(scene.goal);
  PredictTimings sum;
  predictor.predict(scene.map, start, goal);  // the first one also makes the buffers
  for ([[maybe_unused]] auto _ : state) {
    const PredictTimings timings = predictor.predict(scene.map, start, goal).timings;
    sum.encode += timings.encode;
    sum.infer += timings.infer;
    sum.region += timings.region;
  }
  const auto mean_us = [](double ms) { return benchmark::Counter(1e3 * ms, benchmark::Counter::kAvgIterations); };
  state.counters["encode_us"] = mean_us(sum.encode);
  state.counters["infer_us"] = mean_us(sum.infer);
  state.counters["region_us"] = mean_us(sum.region);
}

void predict(benchmark::State& state) {
  try {
    measure(state, model_with(static_cast<int>(state.range(1))), maze(side_of(state)));
  } catch (const Error& error) {
    state.SkipWithError(error.what());  // no runtime, no model: the other benchmarks can still run
  }
}

constexpr auto sides = [](auto* row) { row->Arg(256)->Arg(1024)->Unit(benchmark::kMicrosecond); };

BENCHMARK_CAPTURE(encode, clutter, clutter)->Name("encode/clutter")->Apply(sides);
BENCHMARK_CAPTURE(encode, maze, maze)->Name("encode/maze")->Apply(sides);
// wall-clock time: the second thread's work is not in the first one's processor time
BENCHMARK(predict)
    ->Name("predict/maze")
    ->ArgNames({"", "threads"})
    ->ArgsProduct({{256, 1024}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace lrrt::micro
