// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>

#include "common/core/base/result.hpp"

// The module `_rodeira`: what the Python package calls in C++. Its functions are private to the package, which says
// what they mean (python/rodeira).
namespace rodeira::python {

// Raises rodeira.Error with the error's text.
[[noreturn]] void Raise(const base::Error& error);
template <class T>
// The value, or Raise.
T ValueOrRaise(base::Result<T> result) {
  if (!result) Raise(result.error());
  return std::move(result).value();
}

// Each adds its functions to the module, once.
void AddFunctions(pybind11::module_& module);
void AddMeasures(pybind11::module_& module);
void AddWorld(pybind11::module_& module);

}  // namespace rodeira::python
