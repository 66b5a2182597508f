// SPDX-License-Identifier: Apache-2.0
#include "launch/python/extension.hpp"

#include "common/core/base/version.hpp"

namespace rodeira::python {

void Raise(const base::Error& error) {
  const pybind11::object type = pybind11::module_::import("rodeira.errors").attr("Error");
  PyErr_SetString(type.ptr(), error.Text().c_str());
  throw pybind11::error_already_set();
}

}  // namespace rodeira::python

PYBIND11_MODULE(_rodeira, module) {
  module.doc() = "What the package rodeira calls in C++.";
  module.attr("version") = std::string(rodeira::base::Version());
  rodeira::python::AddFunctions(module);
  rodeira::python::AddMeasures(module);
  rodeira::python::AddWorld(module);
}
