// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "common/core/base/files.hpp"
#include "launch/rodeira/commands/measures_command.hpp"
#include "tests/launch/rodeira/replay/replay_fixture.hpp"
#include "tests/launch/rodeira/said.hpp"

namespace rodeira::cli {

// Short runs, recorded and measured.
class MeasuresCommand : public ReplayTest {
 protected:
  std::string Path(const char* name) const { return (folder_.path() / name).string(); }
  std::string ReadBack(const char* name) const { return base::ReadText(Path(name)).value(); }
  static Said Of(const MeasuresOptions& options) { return SaidBy<MeasuresOptions>(Measures, options); }

  // The rows of a table without quotes, by column.
  static std::vector<std::map<std::string, std::string>> Rows(const std::string& csv) {
    std::vector<std::map<std::string, std::string>> rows;
    std::vector<std::string> header;
    std::istringstream lines(csv);
    for (std::string line; std::getline(lines, line);) {
      std::vector<std::string> cells;
      std::istringstream in(line + ",");
      for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
      if (header.empty()) {
        header = cells;
        continue;
      }
      std::map<std::string, std::string> row;
      for (std::size_t i = 0; i < header.size() && i < cells.size(); ++i) row[header[i]] = cells[i];
      rows.push_back(row);
    }
    return rows;
  }
};

}  // namespace rodeira::cli
