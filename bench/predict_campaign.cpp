// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <mutex>
#include <utility>

#include "campaign.hpp"
#include "lrrt/predict/onnx_predictor.hpp"
#include "lrrt/stopwatch.hpp"
#include "maze.hpp"
#include "models.hpp"

namespace lrrt::bench {
namespace {

/// First calls of a session pay for memory and caches that later ones find ready.
constexpr int warm_up = 5;

/// A map with a start and a goal at the ends of its longest way.
struct Scene {
  OccupancyMap map;
  Eigen::Vector2d start;
  Eigen::Vector2d goal;
};

std::vector<Scene> make_scenes(const PredictSuite& suite, int size) {
  Random random(suite.seed);
  std::vector<Scene> scenes;
  for (int i = 0; i < suite.mazes; ++i) {
    const OccupancyMap maze = perfect_maze(suite.level, static_cast<MazeAlgorithm>(i % 3), random);
    const auto [start, goal] = farthest_pixels(maze);
    scenes.push_back({drawn(maze, size), drawn_center(maze, start, size), drawn_center(maze, goal, size)});
  }
  return scenes;
}

/// One setting to measure.
struct Setting {
  std::string model;
  std::filesystem::path file;
  OnnxOptions onnx;
  int size;
};

std::string id_of(const Setting& s) {
  return s.model + " threads=" + std::to_string(s.onnx.threads) + (s.onnx.spinning ? " spinning" : "") +
         " size=" + std::to_string(s.size);
}

Json measured(const OnnxPredictor& predictor, const std::vector<Scene>& scenes, int runs, const CancelToken& cancel) {
  Json times = Json::array();
  std::size_t area = 0;
  for (int i = -warm_up; i < runs && !cancel.cancelled(); ++i) {
    const Scene& scene = scenes[static_cast<std::size_t>(i + warm_up) % scenes.size()];
    const Stopwatch watch;
    const Prediction prediction = predictor.predict(scene.map, scene.start, scene.goal);
    const double all = watch.total_ms();
    if (i < 0) continue;
    const PredictTimings& t = prediction.timings;
    times.push_back({t.encode, t.infer, t.region, all});
    area += prediction.region.area();
  }
  return {{"area", area}, {"times", std::move(times)}};
}

Json run_setting(const Setting& setting, const PredictSuite& suite, const CancelToken& cancel) {
  const OnnxPredictor predictor(setting.file, setting.onnx);
  Json row = {{"model", setting.model}, {"name", predictor.info().name},   {"input_size", predictor.info().input.size},
              {"size", setting.size},   {"threads", setting.onnx.threads}, {"spinning", setting.onnx.spinning}};
  row.update(measured(predictor, make_scenes(suite, setting.size), suite.runs, cancel));
  return row;
}

std::vector<Setting> settings_of(const Suite& suite, const PredictSuite& body) {
  std::vector<Setting> settings;
  for (const std::string& pattern : body.models) {
    for (const std::string& model : matching_models(suite, pattern)) {
      for (const int threads : body.threads) {
        for (const bool spinning : body.spinning) {
          if (spinning && threads == 1) continue;  // a single thread has no other to wait for
          for (const int size : body.sizes) {
            settings.push_back({model, model_path(suite, model), {threads, spinning}, size});
          }
        }
      }
    }
  }
  return settings;
}

}  // namespace

Campaign predict_campaign(const Suite& suite, const CancelToken& cancel) {
  const auto& body = std::get<PredictSuite>(suite.body);
  Campaign campaign;
  for (const Setting& setting : settings_of(suite, body)) {
    if (!campaign.inputs["models"].contains(setting.model)) {
      const OnnxPredictor predictor(setting.file);  // a broken model is found before anything is measured
      campaign.onnxruntime = predictor.info().runtime_version;
      campaign.inputs["models"][setting.model] = file_checksum(setting.file);
    }
    const std::size_t pair = campaign.jobs.size();
    campaign.jobs.push_back({id_of(setting), id_of(setting), [=] { return run_setting(setting, body, cancel); }, pair});
  }
  return campaign;
}

}  // namespace lrrt::bench
