// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/tree.hpp"

namespace rodeira::system_test {

// The lines of docs/reference/ends.md as columns of tables: texts without quotes and outer spaces. The first column is
// what stands before the first bar: nothing in a table.
inline std::vector<std::vector<std::string>> EndsTableLines() {
  std::vector<std::vector<std::string>> lines;
  std::ifstream page(SourceDir() + "/docs/reference/ends.md");
  for (std::string line; std::getline(page, line);) {
    std::vector<std::string>& columns = lines.emplace_back();
    std::istringstream in(line);
    for (std::string column; std::getline(in, column, '|');) {
      std::erase(column, '`');
      const auto begin = column.find_first_not_of(' ');
      columns.push_back(begin == std::string::npos ? ""
                                                   : column.substr(begin, column.find_last_not_of(' ') - begin + 1));
    }
  }
  return lines;
}

// A row of a cause, without a column for the part: outcomes by policy, as `stop`, `pause`, `restart`.
struct EndsRow {
  std::string cause, message;
  std::array<std::string, 3> outcomes;
};

// The rows of the causes for which is_wanted(cause).
template <class Wanted>
std::vector<EndsRow> EndsRowsOf(const Wanted& is_wanted) {
  std::vector<EndsRow> rows;
  for (const std::vector<std::string>& columns : EndsTableLines()) {
    if (columns.size() == 6 && is_wanted(columns[1]))
      rows.push_back({columns[1], columns[2], {columns[3], columns[4], columns[5]}});
  }
  return rows;
}

}  // namespace rodeira::system_test
