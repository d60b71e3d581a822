// SPDX-License-Identifier: BSD-3-Clause
#include "bindings.hpp"
#include "lrrt/error.hpp"
#include "lrrt/map/moving_ai.hpp"
#include "lrrt/map/read_map.hpp"

namespace lrrt::python {
namespace {

/// What Python's decoder returned: (H, W) or (H, W, C) bytes.
Image image_from(const py::object& decoded) {
  const auto array = DenseArray<std::uint8_t>::ensure(decoded);
  if (!array || array.ndim() < 2 || array.ndim() > 3) {
    throw MapError("the image decoder must return a uint8 array of shape (H, W) or (H, W, C)");
  }
  Image image;
  image.height = static_cast<int>(array.shape(0));
  image.width = static_cast<int>(array.shape(1));
  image.channels = array.ndim() == 3 ? static_cast<int>(array.shape(2)) : 1;
  image.pixels.assign(array.data(), array.data() + array.size());
  return image;
}

OccupancyMap read(const std::filesystem::path& path, const py::function& decode) {
  return read_map(path, [&](const std::filesystem::path& picture) { return image_from(decode(picture)); });
}

}  // namespace

void bind_read_map(py::module_& module) {
  module.def(
      "read_map", &read, py::arg("path"), py::arg("decode"),
      "Map from a picture, a ROS map_server YAML or a MovingAI .map file.\n\n"
      "`decode` turns the path of a picture into a uint8 array (H, W) or (H, W, C), C from 1 to 4. Raises MapError.");

  py::class_<Scenario>(module, "Scenario", "One problem of a MovingAI .scen file.")
      .def_readonly("bucket", &Scenario::bucket, "Difficulty class.")
      .def_property_readonly(
          "map",
          [](const Scenario& s) { return py::reinterpret_steal<py::str>(PyUnicode_DecodeFSDefault(s.map.c_str())); },
          "Path of the map as the file gives it.")
      .def_readonly("width", &Scenario::width, "Width of the map, pixels.")
      .def_readonly("height", &Scenario::height, "Height of the map, pixels.")
      .def_property_readonly(
          "start", [](const Scenario& s) { return py::make_tuple(s.start.c + 0.5, s.start.r + 0.5); },
          "Centre of the start pixel (x, y).")
      .def_property_readonly(
          "goal", [](const Scenario& s) { return py::make_tuple(s.goal.c + 0.5, s.goal.r + 0.5); },
          "Centre of the goal pixel (x, y).")
      .def_readonly("optimal_length", &Scenario::optimal_length, "Length of the shortest grid path, pixels.");
  module.def("read_scenarios", &read_scenarios, py::arg("path"), py::call_guard<py::gil_scoped_release>(),
             "The problems of a MovingAI .scen file. Raises MapError.");
}

}  // namespace lrrt::python
