// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>
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
    for (auto family : {LateralMeasures, SteeringMeasures, SpeedMeasures, LeaderMeasures, EncounterMeasures,
                        DriverMeasures, LaneChangeTestMeasures}) {
      auto measures = family();
      std::move(measures.begin(), measures.end(), std::back_inserter(all));
    }
    return all;
  }();
  return kCatalogue;
}

base::Result<const MeasureInfo*> FindMeasure(const std::string& name) {
  std::vector<std::string> names;
  for (const MeasureInfo& info : Catalogue()) {
    if (name == info.name) return &info;
    names.emplace_back(info.name);
  }
  const std::string nearest = base::NearestName(name, names);
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
  if (info.options.empty()) return text + "options   none\n";
  text += "options\n";
  for (const OptionInfo& option : info.options)
    text += fmt::format("  {:<20}  {:<8g}  {}\n", option.name, option.default_value, option.meaning);
  return text;
}

}  // namespace rodeira::measures
