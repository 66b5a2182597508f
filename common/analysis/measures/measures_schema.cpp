// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/measures_schema.hpp"

#include "common/analysis/measures/catalogue.hpp"

namespace rodeira::measures {
namespace {

using config::ComputedTextKey;
using config::WithDefaultNote;

config::Key IntervalsKey() {
  return config::ListKey(
      "intervals",
      {config::RequiredTextKey("name", "bend", "Name of the interval."),
       ComputedTextKey("from", "required without `while`", "start", "Point where it begins."),
       ComputedTextKey("to", "required without `while`, `for_s`", "end", "Point where it ends."),
       WithDefaultNote("to `to`",
                       config::OptionalNumberKey("for_s", config::Range::Positive(), "Time from `from` on.")),
       ComputedTextKey("while", "always", "speed_mps > 20", "Condition; each time that it holds is an interval."),
       WithDefaultNote("0", config::OptionalNumberKey("min_s", config::Range::Positive(),
                                                      "Shortest time that the condition holds."))},
      "Parts of each recording; without any, the whole.");
}

config::Key MeasuresKey() {
  std::vector<std::string> names;
  for (const MeasureInfo& info : Catalogue()) names.emplace_back(info.name);
  for (const auto& [theirs, own] : NamesOfHighD()) names.emplace_back(theirs);
  return WithDefaultNote(
      "all", config::ListKey("measures", config::Summarised("names of `--list`", config::WordItem(std::move(names))),
                             "Columns of the table."));
}

config::Key OptionsOf(std::string name, const MeasureInfo& info) {
  std::vector<config::Key> options;
  for (const OptionInfo& option : info.options)
    options.push_back(config::NumberKey(option.name, {option.low, option.high}, option.default_value, option.meaning));
  return config::MappingKey(std::move(name), std::move(options), "Options of the measure.");
}

config::Key OptionsKey() {
  std::vector<config::Key> measures;
  for (const MeasureInfo& info : Catalogue()) measures.push_back(OptionsOf(info.name, info));
  for (const auto& [theirs, own] : NamesOfHighD())
    measures.push_back(OptionsOf(std::string(theirs), *FindMeasure(std::string(own)).value()));
  return config::Summarised("those of `--explain NAME`",
                            config::MappingKey("options", std::move(measures), "Options, by measure."));
}

config::Key LaneChangeTestKey() {
  constexpr double kFar_m = 1e6;
  return config::MappingKey(
      "lane_change_test",
      {config::RequiredNumberKey("start_t_m", {-kFar_m, kFar_m}, "Lateral position before the signs."),
       WithDefaultNote("any", config::OptionalIntegerKey("road", 0, 1'000'000, "Index of the road.")),
       config::Required(
           config::ListKey("signs",
                           {config::RequiredNumberKey("s_m", {-kFar_m, kFar_m}, "Station of a sign; ascending."),
                            config::RequiredNumberKey("t_m", {-kFar_m, kFar_m}, "Position that it demands.")},
                           "Signs that demand a lane."))},
      "Signs of the lane change test (ISO 26022).");
}

// What a sidecar of a table has, too.
config::Key SidecarKey(std::string name, std::string sample, std::string meaning) {
  return config::OtherKey(std::move(name), "written with a table", std::move(sample), std::move(meaning));
}

}  // namespace

const config::Schema& MeasuresSchema() {
  static const config::Schema schema{
      "measures", "measures/1", "Intervals and measures of recordings.",
      config::FileKeys("measures/1",
                       {ComputedTextKey("subject", "the first vehicle", "ego", "Vehicle node, or `agent:ID`."),
                        ComputedTextKey("baseline", "none", "calm", "Interval that is the driver's baseline."),
                        IntervalsKey(), MeasuresKey(), OptionsKey(), LaneChangeTestKey(),
                        SidecarKey("recordings", "[]", "What the table was made of; not read."),
                        SidecarKey("version", "0.1.0", "Version that wrote it; not read."),
                        SidecarKey("values", "{}", "What else was used; not read.")})};
  return schema;
}

}  // namespace rodeira::measures
