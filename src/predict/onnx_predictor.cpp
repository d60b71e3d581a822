// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/predict/onnx_predictor.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "input_output.hpp"
#include "lrrt/error.hpp"
#include "model_info.hpp"
#include "onnx_runtime.hpp"
#include "predict_regions.hpp"

namespace lrrt {
namespace {

constexpr const char* input_name = "image";
constexpr const char* output_name = "probability";

Ort::Env& environment() {
  static Ort::Env env(ORT_LOGGING_LEVEL_ERROR, "lrrt");
  return env;
}

Ort::SessionOptions session_options(const OnnxOptions& options) {
  const unsigned cores = std::max(1U, std::thread::hardware_concurrency());
  Ort::SessionOptions result;
  result.SetIntraOpNumThreads(options.threads > 0 ? options.threads : static_cast<int>(std::min(2U, cores)));
  result.SetInterOpNumThreads(1);
  result.SetExecutionMode(ORT_SEQUENTIAL);
  result.SetGraphOptimizationLevel(ORT_ENABLE_ALL);
  result.AddConfigEntry("session.intra_op.allow_spinning", options.spinning ? "1" : "0");
  return result;
}

/// Checks one input or output against the contract; -1 stands for any number. A graph whose sides are fixed takes one.
/// @return whether it holds any number of pictures; else one.
bool check_tensor(const ModelInfo& info, const Ort::TypeInfo& type, const char* name, ONNXTensorElementDataType element,
                  std::int64_t channels) {
  if (type.GetONNXType() != ONNX_TYPE_TENSOR)
    throw ModelError("model " + info.path.string() + ": '" + name + "' is not a tensor");
  const auto tensor = type.GetTensorTypeAndShapeInfo();
  const std::vector<std::int64_t> shape = tensor.GetShape();
  const std::int64_t side = info.input.size;
  const bool one_side = info.input.smaller.empty();
  const auto any_or = [](std::int64_t value, std::int64_t expected) { return value == -1 || value == expected; };
  const bool square = shape.size() == 4 &&
                      (one_side ? any_or(shape[2], side) && any_or(shape[3], side) : shape[2] == -1 && shape[3] == -1);
  const bool fits = square && any_or(shape[0], 1) && shape[1] == channels;
  if (!fits || tensor.GetElementType() != element) {
    throw ModelError("model " + info.path.string() + ": '" + name + "' has shape " + shape_text(shape) +
                     " and element type " + std::to_string(tensor.GetElementType()) + ", expected " +
                     shape_text({-1, channels, one_side ? side : -1, one_side ? side : -1}) + " and type " +
                     std::to_string(element) + ". Its metadata and its graph do not belong together.");
  }
  return shape[0] == -1;
}

void check_name(const ModelInfo& info, std::size_t count, const Ort::AllocatedStringPtr& name, const char* expected) {
  if (count == 1 && std::string(name.get()) == expected) return;
  throw ModelError("model " + info.path.string() + " has " + std::to_string(count) + " tensors, the first named '" +
                   name.get() + "', where exactly one named '" + expected + "' is expected");
}

}  // namespace

/// The loaded model and the buffers of the calls under way.
class OnnxPredictor::Session {
 public:
  /// Buffers of one call; they grow to what calls need.
  struct Workspace {
    PictureBatches batches;
    std::vector<float> probability;
  };

  Session(const std::filesystem::path& path, const OnnxOptions& options)
      : session_(environment(), path.c_str(), session_options(options)),
        memory_(Ort::MemoryInfo::CreateCpu(OrtArenaAllocator, OrtMemTypeDefault)),
        info_(read_info(path)),
        encoder_(info_.input) {
    Ort::AllocatorWithDefaultOptions allocator;
    check_name(info_, session_.GetInputCount(), session_.GetInputNameAllocated(0, allocator), input_name);
    check_name(info_, session_.GetOutputCount(), session_.GetOutputNameAllocated(0, allocator), output_name);
    const bool many_in =
        check_tensor(info_, session_.GetInputTypeInfo(0), input_name, ONNX_TENSOR_ELEMENT_DATA_TYPE_UINT8, 3);
    const bool many_out =
        check_tensor(info_, session_.GetOutputTypeInfo(0), output_name, ONNX_TENSOR_ELEMENT_DATA_TYPE_FLOAT,
                     static_cast<std::int64_t>(info_.classes.size()));
    one_by_one_ = !many_in || !many_out;
  }

  const ModelInfo& info() const { return info_; }

  std::vector<Prediction> predict(const OccupancyMap& map, const std::vector<RegionQuery>& queries) {
    std::unique_ptr<Workspace> workspace = idle_.borrow([] { return std::make_unique<Workspace>(); });
    const auto run_network = [&](std::vector<std::uint8_t>& images, std::size_t count, int side) {
      return run(images, static_cast<std::int64_t>(count), side, workspace->probability);
    };
    try {
      auto predictions = predict_regions({info_, encoder_, one_by_one_, run_network}, map, queries, workspace->batches);
      idle_.give_back(std::move(workspace));
      return predictions;
    } catch (const Ort::Exception& error) {
      throw ModelError("model " + info_.path.string() + " failed: " + error.what());
    }
  }

 private:
  /// Runs the network on `count` pictures of side × side pixels. @param probability receives its output, picture by
  /// picture, class by class; grown where it is too small. @return its begin.
  const float* run(std::vector<std::uint8_t>& images, std::int64_t count, std::int64_t side,
                   std::vector<float>& probability) {
    const auto classes = static_cast<std::int64_t>(info_.classes.size());
    const std::array<std::int64_t, 4> input_shape{count, 3, side, side};
    const std::array<std::int64_t, 4> output_shape{count, classes, side, side};
    const auto pixels = static_cast<std::size_t>(count * side * side);
    const std::size_t outputs = info_.classes.size() * pixels;
    if (probability.size() < outputs) probability.resize(outputs);
    const Ort::Value input = Ort::Value::CreateTensor<std::uint8_t>(memory_, images.data(), 3 * pixels,
                                                                    input_shape.data(), input_shape.size());
    Ort::Value output =
        Ort::Value::CreateTensor<float>(memory_, probability.data(), outputs, output_shape.data(), output_shape.size());
    session_.Run(Ort::RunOptions{nullptr}, &input_name, &input, 1, &output_name, &output, 1);
    return probability.data();
  }

  ModelInfo read_info(const std::filesystem::path& path) {
    const Ort::ModelMetadata metadata = session_.GetModelMetadata();
    Ort::AllocatorWithDefaultOptions allocator;
    ModelInfo info = read_model_info(path, [&](const std::string& key) -> std::optional<std::string> {
      const auto value = metadata.LookupCustomMetadataMapAllocated(key.c_str(), allocator);
      if (!value) return std::nullopt;
      return std::string(value.get());
    });
    info.runtime_version = open_onnx_runtime();
    return info;
  }

  Ort::Session session_;
  Ort::MemoryInfo memory_;
  ModelInfo info_;
  Encoder encoder_;
  bool one_by_one_ = false;
  Pool<Workspace> idle_;
};

OnnxPredictor::OnnxPredictor(const std::filesystem::path& model, OnnxOptions options) {
  check_model_file(model, "an ONNX file");
  check_threads(options.threads);
  open_onnx_runtime();
  try {
    session_ = std::make_unique<Session>(model, options);
  } catch (const Ort::Exception& error) {
    throw ModelError("model " + model.string() + " cannot be loaded by ONNX Runtime: " + error.what());
  }
}

OnnxPredictor::~OnnxPredictor() = default;
OnnxPredictor::OnnxPredictor(OnnxPredictor&&) noexcept = default;
OnnxPredictor& OnnxPredictor::operator=(OnnxPredictor&&) noexcept = default;

const ModelInfo& OnnxPredictor::info() const {
  return session_->info();
}

Prediction OnnxPredictor::predict(const OccupancyMap& map, const Eigen::Vector2d& start,
                                  const Eigen::Vector2d& goal) const {
  return std::move(session_->predict(map, {{start, goal}}).front());
}

std::vector<Prediction> OnnxPredictor::predict_many(const OccupancyMap& map,
                                                    const std::vector<RegionQuery>& queries) const {
  check_queries(map, queries);
  return session_->predict(map, queries);
}

}  // namespace lrrt
