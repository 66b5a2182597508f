// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/analysis/measures/drive.hpp"
#include "common/analysis/measures/lane_change_test.hpp"
#include "common/core/base/result.hpp"

// The measures of a table, by name: what `rodeira measures --list` and `--explain` say, and how each is computed.
namespace rodeira::measures {

// The samples of a drive that a value is computed from.
struct DriveCut {
  const Drive& drive;
  std::size_t from = 0, to = 0;
  std::optional<std::pair<std::size_t, std::size_t>> baseline;  // of the same driver
  const LaneChangeTest* lane_change_test = nullptr;             // null: there is none

  Series operator()(const std::vector<double>& column) const { return Part(column, from, to); }
};

// An option of a measure: a number.
struct OptionInfo {
  const char* name;  // with its unit
  double default_value;
  double low, high;  // of allowed values
  const char* meaning;
};
// The values of a measure's options.
class OptionValues {
 public:
  OptionValues(std::span<const OptionInfo> infos, const std::map<std::string, double>& given)
      : infos_(infos), given_(given) {}
  double operator[](std::string_view name) const;

 private:
  std::span<const OptionInfo> infos_;
  const std::map<std::string, double>& given_;
};

// What is known of a measure; texts are in English, for people.
struct MeasureInfo {
  const char* name;  // its column, with the unit: "sdlp_m"
  const char* family;
  const char* definition;  // one line
  const char* equation;
  const char* traps;
  const char* source;
  std::vector<OptionInfo> options;
  Measure (*compute)(const DriveCut& cut, const OptionValues& options);
};

// All of them, in the order of a table's columns.
const std::vector<MeasureInfo>& Catalogue();
// Names of measures in highD's files (minTTC), each with that of this catalogue.
std::span<const std::pair<std::string_view, std::string_view>> NamesOfHighD();
// Also by the name of highD's files. Wrong input, with the nearest right name, where there is none.
base::Result<const MeasureInfo*> FindMeasure(const std::string& name);

// By family, for Catalogue().
std::vector<MeasureInfo> LateralMeasures();
std::vector<MeasureInfo> LaneChangeMeasures();
std::vector<MeasureInfo> SteeringMeasures();
std::vector<MeasureInfo> SpeedMeasures();
std::vector<MeasureInfo> LeaderMeasures();
std::vector<MeasureInfo> EncounterMeasures();
std::vector<MeasureInfo> DriverMeasures();
std::vector<MeasureInfo> LaneChangeTestMeasures();

// `rodeira measures --list`: a line a measure. `--explain NAME`: all that is known of one.
std::string ListText();
std::string ExplainText(const MeasureInfo& info);

}  // namespace rodeira::measures
