// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace lrrt::python {

namespace py = pybind11;

/// Each room of the library adds its own names to the module.
void bind_map(py::module_& module);
void bind_read_map(py::module_& module);
void bind_predict(py::module_& module);
void bind_grid_predictors(py::module_& module);
void bind_planner(py::module_& module);

/// A text that may quote a broken file: bytes that are not UTF-8 are replaced.
inline py::str text_of(const std::string& bytes) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()), "replace"));
}

/// A getter of such bytes, for def_property_readonly.
template <typename Owner>
auto text_getter(std::string Owner::*member) {
  return [member](const Owner& owner) { return text_of(owner.*member); };
}

/// Hands a vector to NumPy without copying it: the array owns the vector.
template <typename T>
py::array_t<T> to_array(std::vector<T> values, std::vector<py::ssize_t> shape) {
  auto* owned = new std::vector<T>(std::move(values));
  const py::capsule owner(owned, [](void* data) { delete static_cast<std::vector<T>*>(data); });
  return py::array_t<T>(std::move(shape), owned->data(), owner);
}

template <typename T>
using DenseArray = py::array_t<T, py::array::c_style | py::array::forcecast>;

}  // namespace lrrt::python
