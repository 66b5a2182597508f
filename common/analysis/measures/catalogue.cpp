// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "common/core/base/assert.hpp"
#include "common/core/base/suggest.hpp"

namespace rodeira::measures {

double OptionValues::operator[](std::string_view name) const {
  if (const auto given = given_.find(std::string(name)); given != given_.end()) return given->second;
  const auto info = std::ranges::find(infos_, name, [](const OptionInfo& i) { return std::string_view(i.name); });
  RODEIRA_ASSERT(info != infos_.end());
  return info->default_value;
}

const std::vector<MeasureInfo>& Catalogue() {
  static const std::vector<MeasureInfo> kCatalogue = [] {
    std::vector<MeasureInfo> all;
    for (auto family : {LateralMeasures, LaneChangeMeasures, SteeringMeasures, SpeedMeasures, LeaderMeasures,
                        EncounterMeasures, DriverMeasures, LaneChangeTestMeasures}) {
      auto measures = family();
      std::move(measures.begin(), measures.end(), std::back_inserter(all));
    }
    return all;
  }();
  return kCatalogue;
}

namespace {

// Measures of the data set highD (XX_tracksMeta.csv), and the names that they have here.
constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kNamesOfHighD{{
    {"minDHW", "gap_min_m"},
    {"minTHW", "time_gap_min_s"},
    {"minTTC", "ttc_min_s"},
    {"meanXVelocity", "speed_mean_mps"},
    {"maxXVelocity", "speed_max_mps"},
    {"numLaneChanges", "lane_changes_n"},
    {"traveledDistance", "distance_m"},
}};

}  // namespace

std::span<const std::pair<std::string_view, std::string_view>> NamesOfHighD() { return kNamesOfHighD; }

base::Result<const MeasureInfo*> FindMeasure(const std::string& name) {
  for (const auto& [theirs, own] : kNamesOfHighD) {
    if (name == theirs) return FindMeasure(std::string(own));
  }
  std::vector<std::string> names, stems;  // without the unit
  for (const MeasureInfo& info : Catalogue()) {
    if (name == info.name) return &info;
    names.emplace_back(info.name);
    stems.push_back(names.back().substr(0, names.back().rfind('_')));
  }
  std::string nearest = base::NearestName(name, names);
  if (nearest.empty()) {
    const auto stem = std::ranges::find(stems, base::NearestName(name, stems));
    if (stem != stems.end()) nearest = names[static_cast<std::size_t>(stem - stems.begin())];
  }
  return base::WrongInput("measure.unknown_measure",
                          fmt::format("there is no measure '{}'{}", name,
                                      nearest.empty() ? "; `rodeira measures --list` names them"
                                                      : fmt::format("; did you mean '{}'?", nearest)));
}

std::string ListText() {
  std::string text;
  std::string_view family;
  for (const MeasureInfo& info : Catalogue()) {
    if (family != info.family) text += fmt::format("{}{}\n", family.empty() ? "" : "\n", info.family);
    family = info.family;
    text += fmt::format("  {:<30}  {} [{}]\n", info.name, info.definition, info.source);
  }
  return text;
}

std::string ExplainText(const MeasureInfo& info) {
  std::string text = fmt::format("{}\n{}\n\nequation  {}\ntraps     {}\nsource    {}\n", info.name, info.definition,
                                 info.equation, info.traps, info.source);
  for (const auto& [theirs, own] : kNamesOfHighD) {
    if (own == info.name) text += fmt::format("highD     {}\n", theirs);
  }
  if (info.options.empty()) return text + "options   none\n";
  text += "options\n";
  for (const OptionInfo& option : info.options)
    text += fmt::format("  {:<20}  {:<8g}  {}\n", option.name, option.default_value, option.meaning);
  return text;
}

}  // namespace rodeira::measures
