// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/data/csv/plain_table.hpp"
#include "common/data/csv/selection.hpp"
#include "common/data/decode/aliases.hpp"
#include "common/data/record/mcap_reader.hpp"

namespace rodeira::csv {

// A table that was written.
struct ExportedTable {
  std::string topic;  // empty: a table of no topic
  std::string file;   // within the folder; in a .mat file the variable
  std::uint64_t messages = 0;
  std::uint64_t rows = 0;
  std::uint64_t bytes = 0;
};

// What an export wrote, what it left out, and why.
struct ExportReport {
  std::vector<ExportedTable> tables;
  std::vector<std::string> left_out;  // topics without a table, and why
  std::vector<std::string> losses;    // what of the recording could not be read
};

// Called now and then with the share that is done, 0 to 1; the export is cancelled where it gives false.
using ExportProgress = std::function<bool(double share)>;

// What is written where.
struct ExportTarget {
  enum class Form {
    kWide,  // a folder of CSV files, a line a row
    kLong,  // a folder of CSV files, a line a value
    kMat,   // one .mat file, a structure a table
  };
  Form form = Form::kWide;
  std::filesystem::path path;
};

// Writes one table a topic (docs/reference/tables.md), with today's names by `aliases`, and the tables `more`. The
// target must not exist, and appears whole or not at all. Messages are read one chunk after the other; a .mat file is
// collected in memory. Wrong input where the target is there already, where the selection names no topic or column of
// the recording, where a message is not what its schema says, or where a table is too large for a .mat file; failed
// where the disk does not take the tables.
base::Result<ExportReport> ExportTables(const record::McapReader& reader, const ExportTarget& target,
                                        const decode::Aliases& aliases, const ExportProgress& progress,
                                        const Selection& selection, std::span<const PlainTable> more);

// The same into a folder of CSV files, a line a row.
base::Result<ExportReport> ExportCsv(const record::McapReader& reader, const std::filesystem::path& folder,
                                     const decode::Aliases& aliases = {}, const ExportProgress& progress = {},
                                     const Selection& selection = {});

}  // namespace rodeira::csv
