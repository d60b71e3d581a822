// SPDX-License-Identifier: BSD-3-Clause
#include <cstring>
#include <exception>

#include "bindings.hpp"
#include "lrrt/error.hpp"

namespace {

namespace py = pybind11;

/// Raises with a text that may quote a broken file: bytes that are not UTF-8 are replaced.
void raise(const py::handle& type, const std::exception& error) {
  const char* text = error.what();
  const auto message = py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(text, static_cast<Py_ssize_t>(std::strlen(text)), "replace"));
  PyErr_SetObject(type.ptr(), message.ptr());
}

void translate(std::exception_ptr pointer) {
  const auto type = [](const char* name) { return py::module_::import("lrrt._core").attr(name); };
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const lrrt::MapError& error) {
    raise(type("MapError"), error);
  } catch (const lrrt::ModelError& error) {
    raise(type("ModelError"), error);
  } catch (const lrrt::RequestError& error) {
    raise(type("RequestError"), error);
  } catch (const lrrt::Error& error) {
    raise(type("Error"), error);
  }
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.doc() = "Compiled core of lrrt: maps, promising regions and guided planners.";

  const py::exception<lrrt::Error> error(module, "Error", PyExc_ValueError);
  const py::exception<lrrt::MapError> map_error(module, "MapError", error.ptr());
  const py::exception<lrrt::ModelError> model_error(module, "ModelError", error.ptr());
  const py::exception<lrrt::RequestError> request_error(module, "RequestError", error.ptr());
  py::register_exception_translator(&translate);

  lrrt::python::bind_map(module);
  lrrt::python::bind_read_map(module);
  lrrt::python::bind_predict(module);
  lrrt::python::bind_grid_predictors(module);
  lrrt::python::bind_planner(module);
}
