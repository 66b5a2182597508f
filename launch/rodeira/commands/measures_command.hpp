// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace rodeira::cli {

// `rodeira measures FILE... [--spec measures.yaml] [--intervals ...] [-o table.csv|.json] [--long] [--series FILE.csv]`
struct MeasuresOptions {
  std::vector<std::string> recordings;
  std::string spec;                    // measures file; empty: all measures with their default options
  std::vector<std::string> intervals;  // NAME=FROM..TO
  std::string baseline;                // name of an interval
  std::string subject;                 // vehicle node, or agent:ID
  std::string out;                     // .csv or .json; empty: a text on the standard output
  bool long_format = false;
  std::string series;  // CSV file of one recording's time series
  bool list = false;
  std::string explain;
  bool quiet = false;
};

// Writes the table of measures, and beside it TABLE.measures.yaml with all options. Status 2 where an option, a
// measures file or a recording is wrong; 1 where the disk does not take the table.
int Measures(const MeasuresOptions& options);

}  // namespace rodeira::cli
