// SPDX-License-Identifier: BSD-3-Clause
#include <optional>

#include "bindings.hpp"
#include "lrrt/error.hpp"
#include "lrrt/predict/encoder.hpp"
#include "lrrt/predict/onnx_predictor.hpp"
#include "lrrt/region/picture.hpp"
#ifdef LRRT_WITH_TORCH
#include "lrrt/predict/torch_predictor.hpp"
#endif

namespace lrrt::python {
namespace {

/// One encoded query: the picture and the way back to the map.
struct Encoding {
  std::vector<std::uint8_t> image;
  InputFit fit;
};

Encoding encode(const Encoder& encoder, const OccupancyMap& map, const Eigen::Vector2d& start,
                const Eigen::Vector2d& goal) {
  Encoding result;
  result.fit = encoder.encode(map, start, goal, result.image);
  return result;
}

py::array_t<std::uint8_t> image_view(const py::object& self) {
  const auto& encoding = self.cast<const Encoding&>();
  py::array_t<std::uint8_t> view({3, encoding.fit.size, encoding.fit.size}, encoding.image.data(), self);
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

void check_shape(const py::array& array, py::ssize_t rows, py::ssize_t columns, const char* what) {
  if (array.ndim() == 2 && array.shape(0) == rows && array.shape(1) == columns) return;
  throw RequestError(std::string(what) + ": expected an array of shape (" + std::to_string(rows) + ", " +
                     std::to_string(columns) + ")");
}

py::array_t<std::uint8_t> to_input(const Encoding& encoding, const py::array& given, std::uint8_t fill) {
  if (given.itemsize() != 1 || (given.dtype().kind() != 'u' && given.dtype().kind() != 'b')) {
    throw RequestError("to_input takes a uint8 or bool array; other numbers would be cut to bytes");
  }
  const DenseArray<std::uint8_t> values(given);
  check_shape(values, encoding.fit.map_height, encoding.fit.map_width, "to_input takes a map-sized array");
  const std::vector<std::uint8_t> source(values.data(), values.data() + values.size());
  const auto side = static_cast<py::ssize_t>(encoding.fit.size);
  return to_array(encoding.fit.to_input(source, fill), {side, side});
}

py::array_t<float> to_map(const Encoding& encoding, const DenseArray<float>& plane) {
  check_shape(plane, encoding.fit.size, encoding.fit.size, "to_map takes an array of the input's size");
  return to_array(encoding.fit.to_map(plane.data()), {encoding.fit.map_height, encoding.fit.map_width});
}

void bind_encoder(py::module_& module) {
  py::class_<Encoding>(module, "Encoding", "One encoded query: the network's picture and the way back to the map.")
      .def_property_readonly("image", &image_view, "(3, S, S) uint8, read-only: red, green, blue plane.")
      .def_property_readonly(
          "size", [](const Encoding& e) { return e.fit.size; }, "Side of the input that was chosen, pixels.")
      .def_property_readonly(
          "scale", [](const Encoding& e) { return e.fit.scale; }, "Input pixels per map pixel.")
      .def_property_readonly(
          "crop",
          [](const Encoding& e) {
            return py::make_tuple(e.fit.crop.c, e.fit.crop.r, e.fit.crop.width, e.fit.crop.height);
          },
          "Part of the map that is shown: (column, row, width, height), map pixels.")
      .def_property_readonly(
          "placed",
          [](const Encoding& e) {
            return py::make_tuple(e.fit.placed.c, e.fit.placed.r, e.fit.placed.width, e.fit.placed.height);
          },
          "Where that part lies in the input: (column, row, width, height), input pixels.")
      .def("to_input", &to_input, py::arg("values"), py::arg("fill") = 1,
           "Nearest resampling of an (H, W) uint8 array of the map onto the (S, S) input; `fill` outside.")
      .def("to_map", &to_map, py::arg("plane"),
           "An (S, S) float32 plane of the input's size back on (H, W) map pixels.");

  py::class_<Encoder>(module, "Encoder", "Turns map, start and goal into the RGB picture that the network sees.")
      .def(py::init([](int size, int marker_side, std::vector<int> smaller, double least_passage) {
             InputSpec spec;
             spec.size = size;
             spec.marker_side = marker_side;
             spec.smaller = std::move(smaller);
             spec.least_passage = least_passage;
             return Encoder(spec);
           }),
           py::arg("size") = 256, py::arg("marker_side") = 5, py::arg("smaller") = std::vector<int>(),
           py::arg("least_passage") = 5.0,
           "`size`: side of the square input; `marker_side`: least side of the start and goal squares; `smaller`: "
           "ascending sides that take its place where passages stay at least `least_passage` wide; all input pixels.")
      .def_property_readonly(
          "size", [](const Encoder& e) { return e.spec().size; }, "Side of the input, pixels.")
      .def_property_readonly(
          "marker_side", [](const Encoder& e) { return e.spec().marker_side; },
          "Least side of the markers, input pixels.")
      .def("encode", &encode, py::arg("map"), py::arg("start"), py::arg("goal"),
           py::call_guard<py::gil_scoped_release>(),
           "Encodes a query; `start` and `goal` in map units. Raises RequestError when one is not on a free pixel.");
}

template <typename T>
py::array region_view(const py::object& self, const std::vector<T>& values, const py::dtype& type) {
  const auto& region = self.cast<const PromisingRegion&>();
  py::array view(type, {region.height(), region.width()}, values.data(), self);
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

py::array_t<std::uint8_t> picture(const PromisingRegion& region, const OccupancyMap& map) {
  return to_array(rgb_picture(map, region), {map.height(), map.width(), 3});
}

PromisingRegion region_from_array(const OccupancyMap& map, const DenseArray<float>& probability,
                                  const Eigen::Vector2d& start, const Eigen::Vector2d& goal, float threshold) {
  check_shape(probability, map.height(), map.width(), "a region takes one probability per pixel of the map");
  return PromisingRegion(map, {probability.data(), probability.data() + probability.size()},
                         OccupancyMap::pixel_of(map.to_pixel(start)), OccupancyMap::pixel_of(map.to_pixel(goal)),
                         threshold);
}

void bind_region(py::module_& module) {
  py::class_<PromisingRegion, std::shared_ptr<PromisingRegion>>(module, "PromisingRegion",
                                                                "Where a path probably lies, over the pixels of a map.")
      .def_static("from_array", &region_from_array, py::arg("map"), py::arg("probability"), py::arg("start"),
                  py::arg("goal"), py::arg("threshold") = 0.5F,
                  "Region from an (H, W) array of probabilities; `start` and `goal` in map units decide `connected`.")
      .def_property_readonly(
          "probability",
          [](const py::object& self) {
            return region_view(self, self.cast<const PromisingRegion&>().probability(), py::dtype::of<float>());
          },
          "(H, W) float32 view, read-only: probability of the promising class.")
      .def_property_readonly(
          "mask",
          [](const py::object& self) {
            return region_view(self, self.cast<const PromisingRegion&>().mask(), py::dtype::of<bool>());
          },
          "(H, W) bool view, read-only: free and promising.")
      .def_property_readonly("connected", &PromisingRegion::connected,
                             "True when start and goal are joined inside the mask.")
      .def_property_readonly("link_area", &PromisingRegion::link_area,
                             "Pixels below the threshold that the predictor took in to join start and goal.")
      .def_property_readonly("bridge_area", &PromisingRegion::bridge_area,
                             "Pixels that plan() added to close gaps; 0 for a region as it was predicted.")
      .def_property_readonly("area", &PromisingRegion::area, "Number of pixels in the mask.")
      .def_property_readonly(
          "coarseness", &PromisingRegion::coarseness,
          "Pixels of the map along the side of a pixel of the region: above 1 where plan() guided by "
          "a coarsened map, see OccupancyMap.coarsened.")
      .def("picture", &picture, py::arg("map"), "(H, W, 3) uint8 picture: the map with the region in green.");
}

void bind_model_info(py::module_& module) {
  py::class_<ModelInfo>(module, "ModelInfo", "What a model file says about the model in it.")
      .def_property_readonly(
          "path", [](const ModelInfo& info) { return info.path; }, "The file.")
      .def_property_readonly("name", text_getter(&ModelInfo::name), "Name of the model.")
      .def_property_readonly(
          "input_size", [](const ModelInfo& info) { return info.input.size; }, "Side of the input, pixels.")
      .def_property_readonly(
          "smaller_inputs", [](const ModelInfo& info) { return info.input.smaller; },
          "Sides, ascending, used instead where passages stay wide enough, pixels.")
      .def_property_readonly(
          "least_passage", [](const ModelInfo& info) { return info.input.least_passage; },
          "Width that passages must keep in a smaller input, input pixels.")
      .def_property_readonly(
          "marker_side", [](const ModelInfo& info) { return info.input.marker_side; },
          "Least side of the start and goal squares, input pixels.")
      .def_property_readonly(
          "classes",
          [](const ModelInfo& info) {
            std::vector<py::str> names;
            for (const std::string& name : info.classes) names.push_back(text_of(name));
            return names;
          },
          "Names of the classes in output order.")
      .def_readonly("threshold", &ModelInfo::threshold, "A pixel is promising from this probability on.")
      .def_property_readonly("training_data", text_getter(&ModelInfo::training_data), "What the model was trained on.")
      .def_property_readonly("training_budget", text_getter(&ModelInfo::training_budget),
                             "How long it was trained, on what.")
      .def_property_readonly("commit", text_getter(&ModelInfo::commit), "Commit of the training code.")
      .def_readonly("runtime_version", &ModelInfo::runtime_version, "Version of the ONNX Runtime or libtorch in use.");
}

std::shared_ptr<OnnxPredictor> load_predictor(const std::optional<std::filesystem::path>& model, int threads,
                                              bool spinning) {
  return std::make_shared<OnnxPredictor>(model ? *model : default_model_path(), OnnxOptions{threads, spinning});
}

using Query = std::pair<Eigen::Vector2d, Eigen::Vector2d>;

std::vector<std::shared_ptr<PromisingRegion>> predict_many(const RegionPredictor& predictor, const OccupancyMap& map,
                                                           const std::vector<Query>& queries) {
  std::vector<RegionQuery> all;
  all.reserve(queries.size());
  for (const auto& [start, goal] : queries) all.push_back({start, goal});
  std::vector<std::shared_ptr<PromisingRegion>> regions;
  regions.reserve(all.size());
  for (Prediction& prediction : predictor.predict_many(map, all)) {
    regions.push_back(std::make_shared<PromisingRegion>(std::move(prediction.region)));
  }
  return regions;
}
/// Stands for a model that could not be loaded: says so whenever it is asked for a region.
class Unloaded final : public RegionPredictor {
 public:
  explicit Unloaded(std::string why) : why_(std::move(why)) {}
  Prediction predict(const OccupancyMap&, const Eigen::Vector2d&, const Eigen::Vector2d&) const override {
    throw ModelError(why_);
  }

 private:
  std::string why_;
};

void bind_predictors(py::module_& module) {
  py::class_<RegionPredictor, std::shared_ptr<RegionPredictor>>(module, "RegionPredictor",
                                                                "Marks where a path probably lies.")
      .def(
          "predict",
          [](const RegionPredictor& predictor, const OccupancyMap& map, const Eigen::Vector2d& start,
             const Eigen::Vector2d& goal) {
            return std::make_shared<PromisingRegion>(predictor.predict(map, start, goal).region);
          },
          py::arg("map"), py::arg("start"), py::arg("goal"), py::call_guard<py::gil_scoped_release>(),
          "The promising region of a query; `start` and `goal` in map units, on free pixels. Raises RequestError, "
          "ModelError.")
      .def(
          "predict_many", &predict_many, py::arg("map"), py::arg("queries"), py::call_guard<py::gil_scoped_release>(),
          "The promising regions of many queries on one map, in their order: those that predict() gives one by one.\n\n"
          "`queries`: pairs (start, goal), or an array of shape (N, 2, 2); map units, on free pixels. A network is "
          "given several pictures at once. Raises RequestError that names the first wrong query, ModelError.")
      .def(
          "predict_timed",
          [](const RegionPredictor& predictor, const OccupancyMap& map, const Eigen::Vector2d& start,
             const Eigen::Vector2d& goal) {
            std::optional<Prediction> prediction;
            {
              const py::gil_scoped_release release;
              prediction = predictor.predict(map, start, goal);
            }
            py::dict timings;
            timings["encode"] = prediction->timings.encode;
            timings["infer"] = prediction->timings.infer;
            timings["region"] = prediction->timings.region;
            return py::make_tuple(std::make_shared<PromisingRegion>(std::move(prediction->region)), timings);
          },
          py::arg("map"), py::arg("start"), py::arg("goal"),
          "As predict(), and the milliseconds of its stages: (region, {encode, infer, region}).");

  py::class_<OnnxPredictor, RegionPredictor, std::shared_ptr<OnnxPredictor>>(
      module, "OnnxPredictor", "Runs an ONNX model; one object serves any number of threads at once.")
      .def(py::init(&load_predictor), py::arg("model") = py::none(), py::arg("threads") = 0,
           py::arg("spinning") = false,
           "Loads a model: a path, or None for the one that ships. `threads`: 0 chooses two (one on a single core).\n\n"
           "Raises ModelError when the file or ONNX Runtime cannot be loaded, or the metadata do not fit.")
      .def_property_readonly("info", &OnnxPredictor::info, "What the file says about the model.");

  py::class_<Unloaded, RegionPredictor, std::shared_ptr<Unloaded>>(
      module, "UnloadedPredictor", "Stands for a model that could not be loaded: every prediction is a ModelError.")
      .def(py::init<std::string>(), py::arg("why"));
}

#ifdef LRRT_WITH_TORCH
void bind_torch(py::module_& module) {
  py::class_<TorchScriptPredictor, RegionPredictor, std::shared_ptr<TorchScriptPredictor>>(
      module, "TorchScriptPredictor", "Runs a TorchScript archive; one object serves any number of threads at once.")
      .def(py::init([](const std::filesystem::path& model, int threads) {
             return std::make_shared<TorchScriptPredictor>(model, TorchOptions{threads});
           }),
           py::arg("model"), py::arg("threads") = 0,
           "Loads an archive. `threads`: of libtorch in this whole process, 0 leaves them alone.\n\n"
           "Raises ModelError when the file cannot be loaded or run, or the metadata do not fit.")
      .def_property_readonly("info", &TorchScriptPredictor::info, "What the file says about the model.");
}
#endif

}  // namespace

void bind_predict(py::module_& module) {
  bind_encoder(module);
  bind_region(module);
  bind_model_info(module);
  bind_predictors(module);
#ifdef LRRT_WITH_TORCH
  bind_torch(module);
#endif
}

}  // namespace lrrt::python
