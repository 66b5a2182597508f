// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/numpy.h>

#include <vector>

namespace rodeira::python {

using Numbers = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

// The numbers of a one-dimensional array.
std::vector<double> VectorOf(const Numbers& numbers);
// A new array with a copy of the numbers.
pybind11::array_t<double> ArrayOf(const std::vector<double>& numbers);

}  // namespace rodeira::python
