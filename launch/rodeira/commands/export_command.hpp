// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace rodeira::cli {

// `rodeira export --csv DIR FILE.mcap`, `--mat FILE.mat`, `--fcd FILE.xml`
struct ExportOptions {
  std::string recording;
  std::string csv;  // the folder
  std::string mat;  // the file
  std::string fcd;  // the file; one of the three is named
  bool long_format = false;
  std::string topics;  // separated by commas, as the columns; empty: all
  std::string columns;
  double rate_hz = 0.0;  // 0: every sample
  std::string from, to;  // points in time (measures::ParseTimePoint); `to` may be "+SECONDS"; empty: no limit
  bool marks = false;    // a table of marks and events
  bool derived = false;  // a table of lanes, gaps and the like, rebuilt from the recording
  std::string subject;   // of the derived table: vehicle node, or agent:ID; empty: the first vehicle
  bool quiet = false;
};

// Writes the tables and says what they are. Status 1 where the recording is not whole: the tables are there then, with
// what could be read.
int Export(const ExportOptions& options);

}  // namespace rodeira::cli
