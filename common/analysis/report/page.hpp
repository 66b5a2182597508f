// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/analysis/measures/table.hpp"
#include "common/world/network/network.hpp"

namespace rodeira::report {

// One recording of a report.
struct ReportedDrive {
  const measures::DriveReading* reading = nullptr;
  const network::Network* network = nullptr;  // null: the world has no roads
  measures::RecordingFacts facts;
  std::vector<std::pair<std::string, std::string>> meta;  // participant, condition ...
  std::vector<measures::MeasuresRow> rows;                // of the spec's measures
};

// One HTML page that needs no other file and no network: facts, map, strips over time, distributions, and the table of
// measures, recordings side by side. The same input gives the same bytes.
std::string ReportPage(const measures::MeasuresSpec& spec, std::span<const ReportedDrive> drives);

// The name of a recording in keys and heads: participant and condition where they are said, otherwise the file.
std::string ShortName(const ReportedDrive& drive);

}  // namespace rodeira::report
