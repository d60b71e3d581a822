// SPDX-License-Identifier: BSD-3-Clause
#include <set>
#include <utility>

#include "campaign.hpp"
#include "lrrt/stopwatch.hpp"
#include "maze.hpp"
#include "models.hpp"

namespace lrrt::bench {
namespace {

/// Calls that are not measured: the first ones of a session pay for memory and caches that later ones find ready.
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
  int batch;
  int size;
};

std::string id_of(const Setting& s) {
  return s.model + " threads=" + std::to_string(s.onnx.threads) + (s.onnx.spinning ? " spinning" : "") +
         (s.batch > 1 ? " batch=" + std::to_string(s.batch) : "") + " size=" + std::to_string(s.size);
}

/// One call: the scene's query, or as many copies of it as a batch has. So batches of any size do the same work.
std::vector<Prediction> predicted(const RegionPredictor& predictor, const Scene& scene, int batch) {
  if (batch > 1) {
    const std::vector<RegionQuery> queries(static_cast<std::size_t>(batch), {scene.start, scene.goal});
    return predictor.predict_many(scene.map, queries);
  }
  std::vector<Prediction> one;
  one.push_back(predictor.predict(scene.map, scene.start, scene.goal));
  return one;
}

/// Calls the predictor until there are `runs` predictions: a call is not cut, so there may be more.
Json measured(const RegionPredictor& predictor, const std::vector<Scene>& scenes, int batch, int runs,
              const CancelToken& cancel) {
  Json times = Json::array();
  std::set<int> sides;
  std::size_t area = 0;
  const int calls = (runs - 1) / batch + 1;
  for (int i = -warm_up; i < calls && !cancel.cancelled(); ++i) {
    const Scene& scene = scenes[static_cast<std::size_t>(i + warm_up) % scenes.size()];
    const Stopwatch watch;
    const std::vector<Prediction> predictions = predicted(predictor, scene, batch);
    const double share = watch.total_ms() / batch;
    if (i < 0) continue;
    for (const Prediction& prediction : predictions) {
      const PredictTimings& t = prediction.timings;
      times.push_back({t.encode, t.infer, t.region, share});
      sides.insert(prediction.input_side);
      area += prediction.region.area();
    }
  }
  return {{"input_sides", sides}, {"area", area}, {"times", std::move(times)}};
}

Json run_setting(const Setting& setting, const PredictSuite& suite, const CancelToken& cancel) {
  const LoadedModel model = load_model(setting.file, setting.onnx);
  Json row = {{"model", setting.model}, {"name", model.info.name},         {"input_size", model.info.input.size},
              {"size", setting.size},   {"threads", setting.onnx.threads}, {"spinning", setting.onnx.spinning},
              {"batch", setting.batch}};
  row.update(measured(*model.predictor, make_scenes(suite, setting.size), setting.batch, suite.runs, cancel));
  return row;
}

/// A single thread has no other to wait for, and libtorch has no such setting.
std::vector<bool> spinning_of(const PredictSuite& suite, const std::filesystem::path& file, int threads) {
  return threads == 1 || is_torchscript(file) ? std::vector<bool>{false} : suite.spinning;
}

void add_settings(const PredictSuite& suite, const std::string& model, const std::filesystem::path& file,
                  std::vector<Setting>& settings) {
  for (const int threads : suite.threads) {
    for (const bool spinning : spinning_of(suite, file, threads)) {
      for (const int batch : suite.batch) {
        for (const int size : suite.sizes) settings.push_back({model, file, {threads, spinning}, batch, size});
      }
    }
  }
}

/// All settings of a suite. @param notes receives what was left out.
std::vector<Setting> settings_of(const Suite& suite, std::vector<std::string>& notes) {
  const auto& body = std::get<PredictSuite>(suite.body);
  std::vector<Setting> settings;
  for (const std::string& pattern : body.models) {
    const MatchingModels models = matching_models(suite, pattern);
    for (const std::string& model : models.found) add_settings(body, model, model_path(suite, model), settings);
    for (const std::string& model : models.left_out) {
      notes.push_back("model " + model + " is left out: TorchScript needs a build with -DLRRT_WITH_TORCH=ON");
    }
  }
  return settings;
}

}  // namespace

Campaign predict_campaign(const Suite& suite, const CancelToken& cancel) {
  const auto& body = std::get<PredictSuite>(suite.body);
  Campaign campaign;
  for (const Setting& setting : settings_of(suite, campaign.notes)) {
    if (!campaign.inputs["models"].contains(setting.model)) {
      const LoadedModel model = load_model(setting.file);  // a broken model is found before anything is measured
      (is_torchscript(setting.file) ? campaign.libtorch : campaign.onnxruntime) = model.info.runtime_version;
      campaign.inputs["models"][setting.model] = file_checksum(setting.file);
    }
    const std::size_t pair = campaign.jobs.size();
    campaign.jobs.push_back({id_of(setting), id_of(setting), [=] { return run_setting(setting, body, cancel); }, pair});
  }
  return campaign;
}

}  // namespace lrrt::bench
