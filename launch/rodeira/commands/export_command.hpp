// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace rodeira::cli {

// `rodeira export --csv DIR FILE.mcap`
struct ExportOptions {
  std::string recording;
  std::string csv;     // the folder
  std::string topics;  // separated by commas, as the columns; empty: all
  std::string columns;
  double rate_hz = 0.0;  // 0: every sample
  std::optional<double> from_s;
  std::optional<double> to_s;
  bool quiet = false;
};

// Writes the tables and says what they are. Status 1 where the recording is not whole: the tables are there then, with
// what could be read.
int Export(const ExportOptions& options);

}  // namespace rodeira::cli
