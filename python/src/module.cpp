// SPDX-License-Identifier: BSD-3-Clause
#include "bindings.hpp"
#include "lrrt/error.hpp"

PYBIND11_MODULE(_core, module) {
  namespace py = pybind11;
  module.doc() = "Compiled core of lrrt: maps, promising regions and guided planners.";

  const auto& error = py::register_exception<lrrt::Error>(module, "Error", PyExc_ValueError);
  py::register_exception<lrrt::MapError>(module, "MapError", error.ptr());
  py::register_exception<lrrt::ModelError>(module, "ModelError", error.ptr());
  py::register_exception<lrrt::RequestError>(module, "RequestError", error.ptr());

  lrrt::python::bind_map(module);
  lrrt::python::bind_read_map(module);
  lrrt::python::bind_predict(module);
  lrrt::python::bind_planner(module);
}
