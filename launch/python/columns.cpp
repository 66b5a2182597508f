// SPDX-License-Identifier: Apache-2.0
#include "launch/python/columns.hpp"

namespace rodeira::python {

std::vector<double> VectorOf(const Numbers& numbers) {
  if (numbers.ndim() != 1) throw pybind11::value_error("an array of one dimension was expected");
  return {numbers.data(), numbers.data() + numbers.size()};
}

pybind11::array_t<double> ArrayOf(const std::vector<double>& numbers) {
  return pybind11::array_t<double>(static_cast<pybind11::ssize_t>(numbers.size()), numbers.data());
}

}  // namespace rodeira::python
