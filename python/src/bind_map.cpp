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

/// Accepts bool and integer arrays; a float array is refused because 0.5 has no meaning here.
py::array checked_cells(const py::object& occupied) {
  const auto array = py::array::ensure(occupied);
  if (!array) throw MapError("occupied is no array: expected an (H, W) array of bool or of integers 0, 1, 2");
  if (array.ndim() != 2 || array.size() == 0) {
    throw MapError("a map needs a 2-D array (height, width) with at least one pixel, but this one has " +
                   std::to_string(array.ndim()) + " dimensions and " + std::to_string(array.size()) + " values");
  }
  const char kind = array.dtype().kind();
  if (kind != 'b' && kind != 'u' && kind != 'i') {
    throw MapError(std::string("array of kind '") + kind +
                   "': expected bool (True = occupied) or integers 0 free, 1 occupied, 2 unknown");
  }
  if (array.size() > max_map_pixels) {
    throw MapError("array of " + std::to_string(array.size()) + " pixels: expected at most " +
                   std::to_string(max_map_pixels));
  }
  if (kind != 'b') {  // before the cast to bytes hides what was there
    const auto low = py::cast<double>(array.attr("min")());
    const auto high = py::cast<double>(array.attr("max")());
    if (low < 0 || high > 2) {
      std::ostringstream text;
      text << "cell values from " << low << " to " << high << ": expected 0 (free), 1 (occupied) or 2 (unknown)";
      throw MapError(text.str());
    }
  }
  return array;
}

OccupancyMap from_array(const py::object& occupied, std::optional<double> resolution,
                        const std::optional<std::array<double, 3>>& origin) {
  const CellArray array(checked_cells(occupied));
  std::vector<Cell> cells(static_cast<std::size_t>(array.size()));
  std::memcpy(cells.data(), array.data(), cells.size());
  const int height = static_cast<int>(array.shape(0));
  const int width = static_cast<int>(array.shape(1));
  if (resolution) {
    const std::array<double, 3> pose = origin.value_or(std::array<double, 3>{0.0, 0.0, 0.0});
    return OccupancyMap(width, height, std::move(cells), *resolution, Pose2{pose[0], pose[1], pose[2]});
  }
  if (origin)
    throw MapError(
        "an origin needs a resolution: without one, map units are pixels and the origin is the top left corner");
  return OccupancyMap(width, height, std::move(cells));
}

/// A read-only view of the map's own cells.
py::array_t<std::uint8_t> cells_view(const py::object& self) {
  const auto& map = self.cast<const OccupancyMap&>();
  py::array_t<std::uint8_t> view({map.height(), map.width()}, reinterpret_cast<const std::uint8_t*>(map.cells().data()),
                                 self);
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

py::array_t<double> path_array(const OccupancyMap& map, const Eigen::Vector2d& start, const Eigen::Vector2d& goal,
                               double clearance, bool smooth) {
  const std::vector<Eigen::Vector2d> path = [&] {
    const py::gil_scoped_release release;
    const ClearanceCost cost{clearance};
    const std::vector<Pixel> pixels = shortest_path(map, OccupancyMap::pixel_of(map.to_pixel(start)),
                                                    OccupancyMap::pixel_of(map.to_pixel(goal)), cost);
    if (smooth) return smoothed(map, pixels, cost);
    std::vector<Eigen::Vector2d> points;
    for (const Pixel p : pixels) points.emplace_back(p.c + 0.5, p.r + 0.5);
    return points;
  }();
  if (path.empty()) {
    std::ostringstream text;
    text << "no free path joins (" << start.x() << ", " << start.y() << ") and (" << goal.x() << ", " << goal.y()
         << "): both ends must be free and lie in the same free component";
    throw RequestError(text.str());
  }
  std::vector<double> flat;
  flat.reserve(2 * path.size());
  for (const Eigen::Vector2d& p : path) {
    const Eigen::Vector2d point = map.to_world(p);
    flat.insert(flat.end(), {point.x(), point.y()});
  }
  return to_array(std::move(flat), {static_cast<py::ssize_t>(path.size()), 2});
}

py::array_t<bool> widened_array(const OccupancyMap& map, const DenseArray<double>& path, double radius) {
  if (path.ndim() != 2 || path.shape(1) != 2) throw RequestError("a path is an (N, 2) array of points in map units");
  std::vector<Eigen::Vector2d> points;
  for (py::ssize_t i = 0; i < path.shape(0); ++i) {
    points.push_back(map.to_pixel({path.at(i, 0), path.at(i, 1)}));
  }
  const std::vector<std::uint8_t> mask = [&] {
    const py::gil_scoped_release release;
    return widened(map, points, radius);
  }();
  py::array_t<bool> result({map.height(), map.width()});
  std::copy(mask.begin(), mask.end(), result.mutable_data());
  return result;
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
                  py::arg("origin") = py::none(),
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
      .def_property_readonly(
          "coarseness", &OccupancyMap::coarseness,
          "Pixels of the map that this one was coarsened from along the side of one of its own; else 1.")
      .def("coarsened", &OccupancyMap::coarsened, py::arg("factor"),
           "The map in larger pixels, free where all of `factor` × `factor` pixels are; map units mean the same on "
           "it.\n\n"
           "`factor` is a power of two; raises MapError otherwise.")
      .def(
          "cropped",
          [](const OccupancyMap& map, int column, int row, int width, int height) {
            return map.cropped({column, row, width, height});
          },
          py::arg("column"), py::arg("row"), py::arg("width"), py::arg("height"),
          "A part of the map; map units mean the same on it. Raises MapError when it leaves the map.")
      .def("to_pixel", &OccupancyMap::to_pixel, py::arg("point"), "Map units to pixel coordinates (x right, y down).")
      .def("to_world", &OccupancyMap::to_world, py::arg("pixel"), "Pixel coordinates to map units.")
      .def("__repr__", &describe);

  module.def(
      "shortest_path", &path_array, py::arg("map"), py::arg("start"), py::arg("goal"), py::arg("clearance") = 0.0,
      py::arg("smooth") = false,
      "Shortest grid path from `start` to `goal` (map units) as (N, 2) points in map units.\n\n"
      "Eight neighbours, no corner is cut. Nearer than `clearance` pixels to an obstacle a step costs up to four\n"
      "times its length. `smooth` pulls the path taut: corners only, any angle; otherwise all pixel centres.\n"
      "Raises RequestError when there is none.");
  module.def(
      "widened", &widened_array, py::arg("map"), py::arg("path"), py::arg("radius"),
      "(H, W) bool, the free pixels within a walking distance of `radius` pixels of a path ((N, 2), map units).\n\n"
      "The path is widened within free space and never leaks through a wall.");
}

}  // namespace lrrt::python
