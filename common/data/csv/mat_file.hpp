// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/data/csv/csv_file.hpp"
#include "common/data/csv/plain_table.hpp"
#include "common/data/csv/spilled_column.hpp"

namespace rodeira::csv {

// Programs read no variable of more bytes.
inline constexpr std::uint64_t kMaxMatBytes = (std::uint64_t{1} << 31) - 1;
// The bytes that a column of numbers takes per row.
inline constexpr std::uint64_t kMatBytesPerNumber = 8;

// A file of MATLAB 5.0 (".mat", version 6 without compression), which MATLAB, Octave and SciPy read. Each table is a
// structure with a field a column: numbers are double, whole numbers of 64 bits uint64, texts a cell array of rows, or
// one text where all rows have the same.
class MatFile {
 public:
  // Failed where it cannot be created.
  static base::Result<MatFile> Create(const std::filesystem::path& path);
  // Wrong input where the variable would be larger than kMaxMatBytes.
  base::Status Add(const PlainTable& table);
  // The same bytes as for the table in memory; one part of a column is in memory at a time.
  base::Status Add(const std::string& name, std::span<const SpilledColumn> columns, const SpillFile& spill);
  // Everything is with the operating system. Failed where the disk refuses.
  base::Status Close() { return file_.Close(); }
  std::uint64_t written_bytes() const { return file_.written_bytes(); }

 private:
  explicit MatFile(CsvFile file) : file_(std::move(file)) {}
  struct Field {
    std::string name;
    std::uint64_t bytes = 0;  // behind the tag of its array
    std::function<base::Status()> write;
  };
  base::Status AddStructure(const std::string& table, std::span<const Field> fields);

  CsvFile file_;
  std::set<std::string> names_;  // of variables
};

// The name as one of MATLAB: letters, digits and '_', at most 63, different from those that are taken, and then taken.
std::string MatName(std::string_view name, std::set<std::string>& taken);
// Appends a text as an element of a cell array.
void AppendMatText(std::string& out, std::string_view text);
// Wrong input that says what the limit is and what to do.
base::Error TooLargeForMat(std::string_view table);

}  // namespace rodeira::csv
