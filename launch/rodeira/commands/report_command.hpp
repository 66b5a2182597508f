// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace rodeira::cli {

// `rodeira report FILE.mcap... -o report.html`
struct ReportOptions {
  std::vector<std::string> recordings;
  std::string out;
  std::string spec;
  std::vector<std::string> intervals;
  std::string baseline, subject;
  bool quiet = false;
};

// Writes the page. Status 2 where a recording, option or measures file is wrong.
int Report(const ReportOptions& options);

}  // namespace rodeira::cli
