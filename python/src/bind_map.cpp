// SPDX-License-Identifier: BSD-3-Clause

#include <optional>
#include <sstream>

#include "bindings.hpp"
#include "lrrt/error.hpp"
#include "lrrt/map/occupancy_map.hpp"
#include "lrrt/map/shortest_path.hpp"

namespace lrrt::python {
namespace {

using CellArray = DenseArray<std::uint8_t>;

std::vector<Cell> cells_from(const CellArray& cells) {
  if (cells.ndim() != 2) {
    throw MapError("a map needs a 2-D array (height, width), but the array has " + std::to_string(cells.ndim()) +
                   " dimensions");
  }
  std::vector<Cell> result(static_cast<std::size_t>(cells.size()));
  const std::uint8_t* source = cells.data();
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (source[i] > 2) {
      throw MapError("cell value " + std::to_string(source[i]) + " at flat index " + std::to_string(i) +
                     ": expected 0 or False (free), 1 or True (occupied) or 2 (unknown)");
    }
    result[i] = static_cast<Cell>(source[i]);
  }
  return result;
}

/// Accepts bool and integer arrays; a float array is refused because 0.5 has no meaning here.
OccupancyMap from_array(const py::array& occupied, std::optional<double> resolution,
                        const std::array<double, 3>& origin) {
  const char kind = occupied.dtype().kind();
  if (kind != 'b' && kind != 'u' && kind != 'i') {
    throw MapError(std::string("array of kind '") + kind +
                   "': expected bool (True = occupied) or integers 0 free, 1 occupied, 2 unknown");
  }
  if (kind == 'i' || occupied.itemsize() > 1) {
    const auto low = py::cast<double>(occupied.attr("min")());
    const auto high = py::cast<double>(occupied.attr("max")());
    if (low < 0 || high > 2) {
      throw MapError("cell values from " + std::to_string(low) + " to " + std::to_string(high) +
                     ": expected 0 (free), 1 (occupied) or 2 (unknown)");
    }
  }
  const CellArray cells(occupied);
  std::vector<Cell> values = cells_from(cells);
  const int height = static_cast<int>(cells.shape(0));
  const int width = static_cast<int>(cells.shape(1));
  if (!resolution) return OccupancyMap(width, height, std::move(values));
  return OccupancyMap(width, height, std::move(values), *resolution, Pose2{origin[0], origin[1], origin[2]});
}

/// A read-only view of the map's own cells.
py::array cells_view(const py::object& self) {
  const auto& map = self.cast<const OccupancyMap&>();
  py::array_t<std::uint8_t> view({map.height(), map.width()}, reinterpret_cast<const std::uint8_t*>(map.cells().data()),
                                 self);
  view.attr("setflags")(py::arg("write") = false);
  return std::move(view);
}

py::array_t<double> path_array(const OccupancyMap& map, const Eigen::Vector2d& start, const Eigen::Vector2d& goal) {
  const std::vector<Pixel> path = [&] {
    const py::gil_scoped_release release;
    return shortest_path(map, OccupancyMap::pixel_of(map.to_pixel(start)), OccupancyMap::pixel_of(map.to_pixel(goal)));
  }();
  if (path.empty()) {
    std::ostringstream text;
    text << "no free path joins (" << start.x() << ", " << start.y() << ") and (" << goal.x() << ", " << goal.y()
         << "): both ends must be free and lie in the same free component";
    throw RequestError(text.str());
  }
  std::vector<double> flat;
  flat.reserve(2 * path.size());
  for (const Pixel p : path) {
    const Eigen::Vector2d point = map.center(p);
    flat.insert(flat.end(), {point.x(), point.y()});
  }
  return to_array(std::move(flat), {static_cast<py::ssize_t>(path.size()), 2});
}

std::string describe(const OccupancyMap& map) {
  std::ostringstream text;
  text << "OccupancyMap(" << map.width() << "×" << map.height() << " pixels";
  if (map.is_metric()) text << ", " << map.resolution() << " m per pixel";
  text << ")";
  return text.str();
}

}  // namespace

void bind_map(py::module_& module) {
  py::class_<OccupancyMap, std::shared_ptr<OccupancyMap>>(module, "OccupancyMap",
                                                          "A grid of free, occupied and unknown pixels and its frame.")
      .def_static("from_array", &from_array, py::arg("occupied"), py::arg("resolution") = py::none(),
                  py::arg("origin") = std::array<double, 3>{0.0, 0.0, 0.0},
                  "Map from an (H, W) array: bool (True = occupied) or integers (0 free, 1 occupied, 2 unknown).\n\n"
                  "Without `resolution` map units are pixels, x right and y down. With it (metres per pixel) they are\n"
                  "metres, y up, and `origin` (x, y, yaw) is the pose of the lower-left corner, as in ROS map_server.\n"
                  "Raises MapError for other shapes, types or values.")
      .def_property_readonly("width", &OccupancyMap::width, "Columns.")
      .def_property_readonly("height", &OccupancyMap::height, "Rows.")
      .def_property_readonly("resolution", &OccupancyMap::resolution, "Map units per pixel; 1 for a plain picture.")
      .def_property_readonly("is_metric", &OccupancyMap::is_metric, "True when map units are metres, y up.")
      .def_property_readonly(
          "origin",
          [](const OccupancyMap& map) { return py::make_tuple(map.origin().x, map.origin().y, map.origin().yaw); },
          "Pose (x, y, yaw) of the lower-left corner; zeros for a plain picture.")
      .def_property_readonly("cells", &cells_view, "(H, W) uint8 view, read-only: 0 free, 1 occupied, 2 unknown.")
      .def(
          "is_free",
          [](const OccupancyMap& map, const Eigen::Vector2d& point) {
            return map.is_free(OccupancyMap::pixel_of(map.to_pixel(point)));
          },
          py::arg("point"), "True when the point (x, y), map units, lies on a free pixel.")
      .def("to_pixel", &OccupancyMap::to_pixel, py::arg("point"), "Map units to pixel coordinates (x right, y down).")
      .def("to_world", &OccupancyMap::to_world, py::arg("pixel"), "Pixel coordinates to map units.")
      .def("__repr__", &describe);

  module.def("shortest_path", &path_array, py::arg("map"), py::arg("start"), py::arg("goal"),
             "Shortest grid path from `start` to `goal` (map units) as (N, 2) pixel centres in map units.\n\n"
             "Eight neighbours, no corner is cut. Raises RequestError when there is none.");
}

}  // namespace lrrt::python
