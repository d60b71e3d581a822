// SPDX-License-Identifier: BSD-3-Clause
#include "bindings.hpp"
#include "lrrt/error.hpp"
#include "lrrt/predict/encoder.hpp"

namespace lrrt::python {
namespace {

/// One encoded query: the picture and the way back to the map.
struct Encoding {
  std::vector<std::uint8_t> image;
  InputFit fit;
  int map_width;
  int map_height;
};

Encoding encode(const Encoder& encoder, const OccupancyMap& map, const Eigen::Vector2d& start,
                const Eigen::Vector2d& goal) {
  Encoding result{{}, {}, map.width(), map.height()};
  result.fit = encoder.encode(map, start, goal, result.image);
  return result;
}

py::array image_view(const py::object& self) {
  const auto& encoding = self.cast<const Encoding&>();
  py::array_t<std::uint8_t> view({3, encoding.fit.size, encoding.fit.size}, encoding.image.data(), self);
  view.attr("setflags")(py::arg("write") = false);
  return std::move(view);
}

void check_shape(const py::array& array, py::ssize_t rows, py::ssize_t columns, const char* what) {
  if (array.ndim() == 2 && array.shape(0) == rows && array.shape(1) == columns) return;
  throw RequestError(std::string(what) + ": expected an array of shape (" + std::to_string(rows) + ", " +
                     std::to_string(columns) + ")");
}

py::array_t<std::uint8_t> to_input(const Encoding& encoding, const DenseArray<std::uint8_t>& values,
                                   std::uint8_t fill) {
  check_shape(values, encoding.map_height, encoding.map_width, "to_input takes a map-sized array");
  const std::vector<std::uint8_t> source(values.data(), values.data() + values.size());
  const auto side = static_cast<py::ssize_t>(encoding.fit.size);
  return to_array(encoding.fit.to_input(source, encoding.map_width, fill), {side, side});
}

py::array_t<float> to_map(const Encoding& encoding, const DenseArray<float>& plane) {
  check_shape(plane, encoding.fit.size, encoding.fit.size, "to_map takes an array of the input's size");
  return to_array(encoding.fit.to_map(plane.data(), encoding.map_width, encoding.map_height),
                  {encoding.map_height, encoding.map_width});
}

void bind_encoder(py::module_& module) {
  py::class_<Encoding>(module, "Encoding", "One encoded query: the network's picture and the way back to the map.")
      .def_property_readonly("image", &image_view, "(3, S, S) uint8, read-only: red, green, blue plane.")
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
      .def(py::init([](int size, int marker_side) {
             InputSpec spec;
             spec.size = size;
             spec.marker_side = marker_side;
             return Encoder(spec);
           }),
           py::arg("size") = 256, py::arg("marker_side") = 5,
           "`size`: side of the square input; `marker_side`: least side of the start and goal squares, input pixels.")
      .def_property_readonly(
          "size", [](const Encoder& e) { return e.spec().size; }, "Side of the input, pixels.")
      .def_property_readonly(
          "marker_side", [](const Encoder& e) { return e.spec().marker_side; },
          "Least side of the markers, input pixels.")
      .def("encode", &encode, py::arg("map"), py::arg("start"), py::arg("goal"),
           py::call_guard<py::gil_scoped_release>(),
           "Encodes a query; `start` and `goal` in map units. Raises RequestError when one is not on a free pixel.");
}

}  // namespace

void bind_predict(py::module_& module) {
  bind_encoder(module);
}

}  // namespace lrrt::python
