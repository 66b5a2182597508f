// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/data/csv/csv_file.hpp"

namespace rodeira::csv {

// A column of texts. Each text is kept once.
struct TextColumn {
  std::vector<std::string> distinct;
  std::vector<std::uint32_t> index;                          // of each row, into `distinct`
  std::map<std::string, std::uint32_t, std::less<>> number;  // of each text in `distinct`

  // One more row.
  void Add(std::string_view text);
  const std::string& operator[](std::size_t row) const { return distinct[index[row]]; }
};

// A column: numbers (NaN: missing), whole numbers of 64 bits, or texts.
struct PlainColumn {
  std::string name;
  std::variant<std::vector<double>, std::vector<std::uint64_t>, TextColumn> values;

  std::size_t size() const;
};

// A table in memory: columns of one length, of which the first is `time_s`.
struct PlainTable {
  std::string name;  // of its file, without ".csv"
  std::vector<PlainColumn> columns;

  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
};

// Writes the table as CSV: a line a row, or with `long_form` a line a value (time_s, column, value) without those that
// are missing. Returns the number of lines below the header.
base::Result<std::uint64_t> WritePlainTable(const PlainTable& table, bool long_form, CsvFile& file);

}  // namespace rodeira::csv
