// SPDX-License-Identifier: Apache-2.0
#include "common/core/plot/table.hpp"

#include "common/core/base/append_format.hpp"

namespace rodeira::plot {

std::string ToCsv(const Table& table) {
  std::string text;
  for (std::size_t c = 0; c < table.names.size(); ++c) text += (c == 0 ? "" : ",") + table.names[c];
  text += "\n";
  for (std::size_t row = 0; row < table.rows(); ++row) {
    for (std::size_t c = 0; c < table.names.size(); ++c)
      base::AppendFormat(text, "{}{}", c == 0 ? "" : ",", table.At(row, c));
    text += "\n";
  }
  return text;
}

}  // namespace rodeira::plot
