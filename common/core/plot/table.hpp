// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace rodeira::plot {

// Columns of numbers, row after row; the first column is what the others are drawn over, mostly time_s.
struct Table {
  std::vector<std::string> names;  // with units: yaw_rate_degps
  std::vector<double> values;

  std::size_t rows() const { return names.empty() ? 0 : values.size() / names.size(); }
  // Precondition: row < rows(), column < names.size().
  double At(std::size_t row, std::size_t column) const { return values[row * names.size() + column]; }
};

// Comma-separated values with a header, each number so that it reads back to the same bits.
std::string ToCsv(const Table& table);
// One small diagram a column over the first one, as SVG; at most 24.
std::string ToSvg(const Table& table, const std::string& title);

}  // namespace rodeira::plot
