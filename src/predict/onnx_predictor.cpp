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
void check_tensor(const ModelInfo& info, const Ort::TypeInfo& type, const char* name, ONNXTensorElementDataType element,
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
  /// Buffers of one call, large enough for the largest picture.
  struct Workspace {
    explicit Workspace(const ModelInfo& info) : probability(info.classes.size() * plane_size(info.input.size)) {
      image.reserve(3 * plane_size(info.input.size));
    }

    std::vector<std::uint8_t> image;
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
    check_tensor(info_, session_.GetInputTypeInfo(0), input_name, ONNX_TENSOR_ELEMENT_DATA_TYPE_UINT8, 3);
    check_tensor(info_, session_.GetOutputTypeInfo(0), output_name, ONNX_TENSOR_ELEMENT_DATA_TYPE_FLOAT,
                 static_cast<std::int64_t>(info_.classes.size()));
  }

  const ModelInfo& info() const { return info_; }

  Prediction predict(const OccupancyMap& map, const Eigen::Vector2d& start, const Eigen::Vector2d& goal) {
    std::unique_ptr<Workspace> workspace = idle_.borrow([&] { return std::make_unique<Workspace>(info_); });
    Prediction prediction = predict_region(info_, encoder_, {map, start, goal}, workspace->image,
                                           [&](int side) { return run(*workspace, side); });
    idle_.give_back(std::move(workspace));
    return prediction;
  }

 private:
  /// Runs the network on the workspace's picture, side × side pixels. @return its output, class by class.
  const float* run(Workspace& workspace, std::int64_t side) {
    const auto classes = static_cast<std::int64_t>(info_.classes.size());
    const std::array<std::int64_t, 4> input_shape{1, 3, side, side};
    const std::array<std::int64_t, 4> output_shape{1, classes, side, side};
    const auto pixels = static_cast<std::size_t>(side * side);
    const Ort::Value input = Ort::Value::CreateTensor<std::uint8_t>(memory_, workspace.image.data(), 3 * pixels,
                                                                    input_shape.data(), input_shape.size());
    Ort::Value output = Ort::Value::CreateTensor<float>(
        memory_, workspace.probability.data(), info_.classes.size() * pixels, output_shape.data(), output_shape.size());
    session_.Run(Ort::RunOptions{nullptr}, &input_name, &input, 1, &output_name, &output, 1);
    return workspace.probability.data();
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
  try {
    return session_->predict(map, start, goal);
  } catch (const Ort::Exception& error) {
    throw ModelError("model " + info().path.string() + " failed: " + error.what());
  }
}

}  // namespace lrrt
