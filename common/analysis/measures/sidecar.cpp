// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "common/analysis/measures/table.hpp"
#include "common/core/base/version.hpp"

namespace rodeira::measures {
namespace {

// As a YAML text in double quotes.
std::string YamlText(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out + '"';
}

std::string PointText(const TimePoint& point) {
  switch (point.kind) {
    case TimePoint::Kind::kStart:
      return "start";
    case TimePoint::Kind::kEnd:
      return "end";
    case TimePoint::Kind::kSeconds:
      return fmt::format("{}", point.seconds);
    default:
      break;
  }
  const bool mark = point.kind == TimePoint::Kind::kMark;
  std::string text = (mark ? "mark:" : "event:") + point.name;
  if (!point.argument.empty()) text += ":" + point.argument;
  if (point.number > 1) text += fmt::format("#{}", point.number);
  return text;
}

}  // namespace

std::string SidecarText(const MeasuresSpec& spec, std::span<const MeasuresRow> rows,
                        std::span<const RecordingFacts> recordings) {
  std::string text = "# The options of a table of measures. `rodeira measures FILE --spec THIS` computes it again.\n";
  text += fmt::format("rodeira: measures/1\nversion: {}\n", YamlText(base::Version()));
  if (!spec.subject.empty()) text += fmt::format("subject: {}\n", YamlText(spec.subject));
  if (!spec.baseline.empty()) text += fmt::format("baseline: {}\n", YamlText(spec.baseline));
  if (!spec.intervals.empty()) text += "intervals:\n";
  for (const IntervalSpec& interval : spec.intervals) {
    text += fmt::format("  - {{name: {}, from: {}, ", YamlText(interval.name), YamlText(PointText(interval.from)));
    text += interval.for_s ? fmt::format("for_s: {}", *interval.for_s)
                           : fmt::format("to: {}", YamlText(PointText(interval.to)));
    if (interval.condition) text += fmt::format(", while: {}", YamlText(interval.condition->text));
    if (interval.min_s > 0.0) text += fmt::format(", min_s: {}", interval.min_s);
    text += "}\n";
  }
  if (const LaneChangeTest& test = spec.lane_change_test; !test.signs.empty()) {
    text += fmt::format("lane_change_test:\n  start_t_m: {}\n", test.start_t_m);
    if (test.road) text += fmt::format("  road: {}\n", *test.road);
    text += "  signs:\n";
    for (const LaneChangeSign& sign : test.signs)
      text += fmt::format("    - {{s_m: {}, t_m: {}}}\n", sign.s_m, sign.target_t_m);
  }
  text += "measures:\n";
  for (const MeasureInfo* info : spec.measures) text += fmt::format("  - {}\n", info->name);
  std::string options;
  static const std::map<std::string, double> kNone;
  for (const MeasureInfo* info : spec.measures) {
    if (info->options.empty()) continue;
    const auto given = spec.options.find(info->name);
    const OptionValues values(info->options, given == spec.options.end() ? kNone : given->second);
    options += fmt::format("  {}: {{", info->name);
    const char* comma = "";
    for (const OptionInfo& option : info->options) {
      options += fmt::format("{}{}: {}", comma, option.name, values[option.name]);
      comma = ", ";
    }
    options += "}\n";
  }
  if (!options.empty()) text += "options:\n" + options;
  text += "recordings:\n";
  for (const RecordingFacts& r : recordings) {
    text += fmt::format("  - file: {}\n    subject: {}\n    content: {}\n    world_hash: {}\n", YamlText(r.file),
                        YamlText(r.subject), YamlText(r.content), YamlText(r.world_hash));
    text += fmt::format("    recorded_by: {}\n", YamlText(r.version + " " + r.commit));
    if (!r.notes.empty()) text += fmt::format("    notes: {}\n", YamlText(r.notes));
  }
  // How the first row's values were computed: what a measure used beyond its options (padding, windows, points).
  text += "values:\n";
  for (std::size_t i = 0; i < spec.measures.size() && !rows.empty(); ++i) {
    const Measure* measure = nullptr;
    for (const MeasuresRow& row : rows) {
      if (measure == nullptr || (!measure->value && row.values[i].value)) measure = &row.values[i];
    }
    text += fmt::format("  {}: {{unit: {}", spec.measures[i]->name, YamlText(measure->unit));
    for (const UsedOption& used : measure->options) text += fmt::format(", {}: {}", used.name, YamlText(used.value));
    text += "}\n";
  }
  return text;
}

}  // namespace rodeira::measures
