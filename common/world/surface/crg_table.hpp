// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/world/surface/crg_header.hpp"

namespace rodeira::surface {

// The numbers of an OpenCRG file, a row for each step of u, a column for each channel; NaN where one is missing.
struct CrgTable {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<double> values;  // row by row

  // Precondition: row < rows, column < columns.
  double At(std::size_t row, std::size_t column) const { return values[row * columns + column]; }
};

// Reads the numbers behind the header, `bytes` being the whole file.
// - LRFI, LDFI: text of 10 or 20 characters a number, 8 or 4 numbers a line; each row begins a line. A number that
// begins
//   with '*' is missing.
// - KRBI, KDBI: big-endian IEEE floats or doubles without gaps; what fills the last 80 bytes up is NaN.
// The rows are those from start_u to end_u where the header has both, otherwise all that are there (two or more). Wrong
// input where numbers are broken, beyond 1e9 or cut short.
base::Result<CrgTable> ReadCrgTable(const CrgHeader& header, std::span<const std::byte> bytes, std::string_view name);

}  // namespace rodeira::surface
