// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/analysis/measures/catalogue.hpp"
#include "common/analysis/measures/intervals.hpp"
#include "common/core/base/result.hpp"

namespace rodeira::measures {

// What is to be computed: a measures file (docs/reference/measures.md), or the options of the command line.
struct MeasuresSpec {
  std::string subject;                  // as DriveQuery::subject
  std::vector<IntervalSpec> intervals;  // none: the whole recording
  std::vector<const MeasureInfo*> measures;
  std::map<std::string, std::map<std::string, double>> options;  // by measure: those that are not the default
  std::string baseline;  // name of the interval that is the driver's baseline; empty: none
  LaneChangeTest lane_change_test;
};

// Every measure, over the whole recording.
MeasuresSpec DefaultSpec();
// Sets an option of a measure. Wrong input where it is unknown (with the nearest name) or out of its range.
base::Status SetOption(const MeasureInfo& info, const std::string& option, double value, MeasuresSpec& spec);
// Wrong input where the baseline is no interval, or one with a condition.
base::Status CheckBaseline(const MeasuresSpec& spec);
// Wrong input, with the place and the nearest right name, where something is unknown, out of range or does not fit.
base::Result<MeasuresSpec> ReadSpec(const std::filesystem::path& file);

// A row of the table: an interval of a recording.
struct MeasuresRow {
  std::string file, participant, condition, run;
  Interval interval;
  std::vector<Measure> values;  // of the spec's measures, in their order
};
// The rows of one recording. The times and reasons of the intervals are found in it.
std::vector<MeasuresRow> ComputeRows(const MeasuresSpec& spec, const DriveReading& reading);

}  // namespace rodeira::measures
