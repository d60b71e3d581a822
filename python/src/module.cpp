// SPDX-License-Identifier: BSD-3-Clause
#include <exception>

#include "bindings.hpp"
#include "lrrt/error.hpp"
#include "lrrt/version.hpp"

namespace {

namespace py = pybind11;

void raise(const py::handle& type, const std::exception& error) {
  PyErr_SetObject(type.ptr(), lrrt::python::text_of(error.what()).ptr());
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

template <typename Exception>
py::handle documented(py::module_& module, const char* name, const py::handle& base, const char* text) {
  const py::exception<Exception> type(module, name, base);
  type.attr("__doc__") = text;
  return type;  // the module holds it
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.doc() = "Compiled core of lrrt: maps, promising regions and guided planners.";
  module.attr("__version__") = lrrt::version;

  const py::handle error = documented<lrrt::Error>(
      module, "Error", PyExc_ValueError,
      "Base of every error that lrrt raises on purpose: it names the value found and what was expected.");
  documented<lrrt::MapError>(module, "MapError", error,
                             "A map that cannot be read or makes no sense: missing file, broken header, wrong sizes.");
  documented<lrrt::ModelError>(module, "ModelError", error,
                               "A model that cannot be loaded or run: no runtime, broken file, unfit metadata.");
  documented<lrrt::RequestError>(module, "RequestError", error,
                                 "A request or an option out of its range: a share above 1, an unknown planner.");
  py::register_exception_translator(&translate);

  lrrt::python::bind_map(module);
  lrrt::python::bind_read_map(module);
  lrrt::python::bind_predict(module);
  lrrt::python::bind_grid_predictors(module);
  lrrt::python::bind_planner(module);
}
