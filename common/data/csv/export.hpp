// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/data/csv/selection.hpp"
#include "common/data/decode/aliases.hpp"
#include "common/data/record/mcap_reader.hpp"

namespace rodeira::csv {

struct ExportedTable {
  std::string topic;
  std::string file;  // within the folder
  std::uint64_t messages = 0;
  std::uint64_t rows = 0;
  std::uint64_t bytes = 0;
};

struct ExportReport {
  std::vector<ExportedTable> tables;
  std::vector<std::string> left_out;  // topics without a table, and why
  std::vector<std::string> losses;    // what of the recording could not be read
};

// Called now and then with the share that is done, 0 to 1; the export is broken off where it gives false.
using ExportProgress = std::function<bool(double share)>;

// Writes one table a topic (docs/reference/tables.md), with today's names by `aliases`, into `folder`, which must not
// exist and appears with whole tables or not at all. Messages are read one chunk after the other. Wrong input where the
// folder is there already, where the selection names no topic or column of the recording, or where a message is not
// what its schema says; failed where the disk does not take the tables.
base::Result<ExportReport> ExportCsv(const record::McapReader& reader, const std::filesystem::path& folder,
                                     const decode::Aliases& aliases = {}, const ExportProgress& progress = {},
                                     const Selection& selection = {});

}  // namespace rodeira::csv
