// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/csv_cell.hpp"

namespace rodeira::base {

std::string CsvCell(std::string_view text) {
  if (text.find_first_of("\",\r\n") == std::string_view::npos) return std::string(text);
  std::string cell = "\"";
  for (const char c : text) {
    if (c == '"') cell += '"';
    cell += c;
  }
  return cell + '"';
}

}  // namespace rodeira::base
