// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/predict/torch_predictor.hpp"

#include <ATen/Parallel.h>
#include <torch/script.h>
#include <torch/version.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "input_output.hpp"
#include "lrrt/error.hpp"
#include "model_info.hpp"
#include "predict_regions.hpp"

namespace lrrt {
namespace {

constexpr const char* metadata_file = "metadata.json";
constexpr const char* advice = "Export the model with this project's training package.";

/// The text of an exception; of libtorch's own without the list of C++ calls.
std::string text_of(const std::exception& error) {
  const auto* own = dynamic_cast<const c10::Error*>(&error);
  return own != nullptr ? own->what_without_backtrace() : error.what();
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& problem) {
  throw ModelError("model " + path.string() + problem);
}

struct Archive {
  torch::jit::Module module;
  std::string metadata;
};

Archive load(const std::filesystem::path& path) {
  torch::jit::ExtraFilesMap extra{{metadata_file, ""}};
  try {
    torch::jit::Module module = torch::jit::load(path.string(), torch::kCPU, extra);
    module.eval();
    return {std::move(module), extra.at(metadata_file)};
  } catch (const std::exception& error) {
    fail(path, " cannot be loaded by libtorch " TORCH_VERSION ": " + text_of(error));
  }
}

ModelInfo read_info(const std::filesystem::path& path, const std::string& metadata) {
  if (metadata.empty()) fail(path, std::string(" has no extra file '") + metadata_file + "'. " + advice);
  const auto json = nlohmann::json::parse(metadata, nullptr, false);
  if (!json.is_object()) fail(path, std::string(": '") + metadata_file + "' is no JSON object. " + advice);
  ModelInfo info = read_model_info(path, [&](const std::string& key) -> std::optional<std::string> {
    const auto found = json.find(key);
    if (found == json.end()) return std::nullopt;
    if (!found->is_string()) fail(path, ": metadata '" + key + "' is not a text. " + advice);
    return found->get<std::string>();
  });
  info.runtime_version = TORCH_VERSION;
  return info;
}

void check_input(const ModelInfo& info, const torch::jit::Module& module) {
  const auto forward = module.find_method("forward");
  if (!forward) fail(info.path, std::string(" has no method 'forward'. ") + advice);
  const std::size_t inputs = forward->function().getSchema().arguments().size() - 1;  // the first is the module itself
  if (inputs != 1) {
    fail(info.path, " takes " + std::to_string(inputs) + " inputs, expected one, the picture. " + advice);
  }
}

/// Checks the output against the contract: of every run, for a program may return what it likes.
void check_output(const ModelInfo& info, const c10::IValue& value, std::int64_t count, std::int64_t side) {
  if (!value.isTensor()) fail(info.path, " returns a " + value.tagKind() + ", expected one tensor. " + advice);
  const at::Tensor& output = value.toTensor();
  const std::vector<std::int64_t> expected{count, static_cast<std::int64_t>(info.classes.size()), side, side};
  if (output.sizes() != expected || output.scalar_type() != at::kFloat) {
    fail(info.path, std::string(" returns shape ") + shape_text(output.sizes().vec()) + " and element type " +
                        c10::toString(output.scalar_type()) + ", expected " + shape_text(expected) + " and " +
                        c10::toString(at::kFloat) + ". Its metadata and its graph do not belong together.");
  }
}

}  // namespace

/// The loaded module and the pictures of the calls under way.
class TorchScriptPredictor::Program {
 public:
  explicit Program(const std::filesystem::path& path) : Program(path, load(path)) {}

  const ModelInfo& info() const { return info_; }

  std::vector<Prediction> predict(const OccupancyMap& map, const std::vector<RegionQuery>& queries) {
    std::unique_ptr<PictureBatches> batches = idle_.borrow([] { return std::make_unique<PictureBatches>(); });
    at::Tensor output;
    const auto run_program = [&](std::vector<std::uint8_t>& images, std::size_t count, int side) {
      output = run(images, static_cast<std::int64_t>(count), side);
      return output.data_ptr<float>();
    };
    auto predictions = predict_regions({info_, encoder_, one_by_one_, run_program}, map, queries, *batches);
    idle_.give_back(std::move(batches));
    return predictions;
  }

 private:
  Program(const std::filesystem::path& path, Archive archive)
      : module_(std::move(archive.module)), info_(read_info(path, archive.metadata)), encoder_(info_.input) {
    check_input(info_, module_);
    std::vector<std::uint8_t> trial(3 * plane_size(info_.input.size));
    for (int i = 0; i < 2; ++i) run(trial, 1, info_.input.size);  // the first run is profiled, the second compiled
    one_by_one_ = !takes_two();
  }

  /// A program that was traced with a single picture may fail on two, or give them the shape of one.
  bool takes_two() {
    const int side = info_.input.smaller.empty() ? info_.input.size : info_.input.smaller.front();
    std::vector<std::uint8_t> images(2 * 3 * plane_size(side));
    try {
      run(images, 2, side);
      return true;
    } catch (const ModelError&) {
      return false;
    }
  }

  at::Tensor run(std::vector<std::uint8_t>& images, std::int64_t count, std::int64_t side) {
    const c10::InferenceMode inference;
    const at::Tensor pictures = torch::from_blob(images.data(), {count, 3, side, side}, torch::kUInt8);
    c10::IValue output;
    try {
      output = module_.forward({pictures});
    } catch (const std::exception& error) {
      fail(info_.path, " failed: " + text_of(error));
    }
    check_output(info_, output, count, side);
    return output.toTensor().contiguous();
  }

  torch::jit::Module module_;
  ModelInfo info_;
  Encoder encoder_;
  bool one_by_one_ = false;
  Pool<PictureBatches> idle_;
};

TorchScriptPredictor::TorchScriptPredictor(const std::filesystem::path& model, TorchOptions options) {
  check_model_file(model, "a TorchScript archive");
  check_threads(options.threads);
  if (options.threads > 0) at::set_num_threads(options.threads);
  program_ = std::make_unique<Program>(model);
}

TorchScriptPredictor::~TorchScriptPredictor() = default;
TorchScriptPredictor::TorchScriptPredictor(TorchScriptPredictor&&) noexcept = default;
TorchScriptPredictor& TorchScriptPredictor::operator=(TorchScriptPredictor&&) noexcept = default;

const ModelInfo& TorchScriptPredictor::info() const {
  return program_->info();
}

Prediction TorchScriptPredictor::predict(const OccupancyMap& map, const Eigen::Vector2d& start,
                                         const Eigen::Vector2d& goal) const {
  return std::move(program_->predict(map, {{start, goal}}).front());
}

std::vector<Prediction> TorchScriptPredictor::predict_many(const OccupancyMap& map,
                                                           const std::vector<RegionQuery>& queries) const {
  check_queries(map, queries);
  return program_->predict(map, queries);
}

}  // namespace lrrt
