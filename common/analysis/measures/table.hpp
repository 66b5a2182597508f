// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "common/analysis/measures/spec.hpp"

// The texts that a table of measures is written as. A missing value is an empty cell, in JSON null.
namespace rodeira::measures {

// One row an interval, one column a measure.
std::string CsvTable(const MeasuresSpec& spec, std::span<const MeasuresRow> rows);
// One row a value: name, value, unit, n, valid share, why it is missing, options.
std::string LongCsvTable(const MeasuresSpec& spec, std::span<const MeasuresRow> rows);
// One array, an object an interval.
std::string JsonTable(const MeasuresSpec& spec, std::span<const MeasuresRow> rows);
// For a terminal: one block an interval, one line a measure.
std::string TextTable(const MeasuresSpec& spec, std::span<const MeasuresRow> rows);
// The time series of a drive: time_s, the columns of DriveColumns, and those that follow from them: TTC, TLC, time gap.
std::string SeriesHeader();
// One line; missing values are empty.
void AppendSeriesRow(const Drive& drive, std::size_t k, std::string& out);

// What stands in the sidecar of a recording.
struct RecordingFacts {
  std::string file, subject;
  std::string version, commit;  // of the program that recorded
  std::string world_hash, content;
  std::string notes;
};
// The sidecar (YAML): a measures file that computes the same table, with the program's version, the recordings and all
// options of all measures.
std::string SidecarText(const MeasuresSpec& spec, std::span<const MeasuresRow> rows,
                        std::span<const RecordingFacts> recordings);

}  // namespace rodeira::measures
