// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "common/analysis/measures/measures_schema.hpp"
#include "common/core/base/suggest.hpp"
#include "common/core/config/declared.hpp"

namespace rodeira::measures {
namespace {

IntervalSpec WholeRecording() {
  IntervalSpec whole;
  whole.name = "all";
  whole.to.kind = TimePoint::Kind::kEnd;
  return whole;
}

void ReadIntervals(const config::DeclaredMap& root, MeasuresSpec& spec) {
  const config::DeclaredList list = root.Items("intervals");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const config::DeclaredMap declared = list.At(i);
    const config::Map& item = declared.map();
    IntervalSpec interval;
    interval.name = declared.Text("name");
    const auto read = [&](const char* key, TimePoint& into) {
      auto point = ParseTimePoint(declared.MapWith(key).Text(key));
      if (point)
        into = std::move(point).value();
      else
        item.Problem(key, point.error().id, point.error().message);
    };
    const bool is_while = item.Has("while");
    interval.to.kind = TimePoint::Kind::kEnd;
    if (!is_while || item.Has("from")) read("from", interval.from);
    interval.for_s = declared.OptionalNumber("for_s");
    if (!item.Has("for_s") && (!is_while || item.Has("to"))) read("to", interval.to);
    if (is_while) {
      auto condition = ParseCondition(declared.Text("while", ""));
      if (condition)
        interval.condition = std::move(condition).value();
      else
        item.Problem("while", condition.error().id, condition.error().message);
      interval.min_s = declared.OptionalNumber("min_s").value_or(0.0);
    }
    if (auto status = CheckInterval(interval); !status) item.Problem("name", status.error().id, status.error().message);
    const auto same = [&](const IntervalSpec& other) { return other.name == interval.name; };
    if (std::ranges::any_of(spec.intervals, same))
      item.Problem("name", "config.duplicate_name", "another interval has the same name");
    spec.intervals.push_back(std::move(interval));
  }
}

void ReadLaneChangeTest(const config::DeclaredMap& root, LaneChangeTest& test) {
  if (!root.map().Has("lane_change_test")) return;
  const config::DeclaredMap map = root.Child("lane_change_test");
  test.start_t_m = map.Number("start_t_m");
  if (const auto road = map.OptionalInteger("road")) test.road = static_cast<int>(*road);
  const config::DeclaredList list = map.Items("signs");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const config::DeclaredMap item = list.At(i);
    const LaneChangeSign sign{item.Number("s_m"), item.Number("t_m")};
    if (!test.signs.empty() && sign.s_m <= test.signs.back().s_m)
      item.map().Problem(
          "s_m", "measure.signs_not_ascending",
          fmt::format("{:g} was found behind {:g}; ascending stations were expected", sign.s_m, test.signs.back().s_m));
    test.signs.push_back(sign);
  }
}

void ReadMeasures(const config::DeclaredMap& root, MeasuresSpec& spec) {
  if (!root.map().Has("measures")) return;
  spec.measures.clear();
  const config::DeclaredList declared = root.Items("measures");
  const config::List& list = declared.list();
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto info = FindMeasure(list.Text(i));
    if (!info)
      list.Problem(i, info.error().id, info.error().message);
    else if (std::ranges::find(spec.measures, info.value()) == spec.measures.end())
      spec.measures.push_back(info.value());
  }
}

void ReadOptions(const config::DeclaredMap& root, MeasuresSpec& spec) {
  const config::DeclaredMap options = root.Child("options");
  for (const std::string& name : options.map().Keys()) {
    const auto info = FindMeasure(name);
    if (!info) {
      options.map().Problem(name, info.error().id, info.error().message);
      continue;
    }
    const config::DeclaredMap own = options.Child(name);
    for (const OptionInfo& option : info.value()->options) {
      if (!own.map().Has(option.name)) continue;
      spec.options[info.value()->name][option.name] = own.Number(option.name);
    }
  }
}

}  // namespace

MeasuresSpec DefaultSpec() {
  MeasuresSpec spec;
  for (const MeasureInfo& info : Catalogue()) spec.measures.push_back(&info);
  return spec;
}

base::Status SetOption(const MeasureInfo& info, const std::string& option, double value, MeasuresSpec& spec) {
  std::vector<std::string> names;
  for (const OptionInfo& known : info.options) {
    names.emplace_back(known.name);
    if (names.back() != option) continue;
    if (!(value >= known.low && value <= known.high))
      return base::WrongInput(
          "config.out_of_range",
          fmt::format("{} = {:g} was found; {:g} to {:g} was expected", option, value, known.low, known.high),
          info.name);
    spec.options[info.name][option] = value;
    return {};
  }
  return base::WrongInput("config.unknown_key",
                          names.empty()
                              ? fmt::format("there is no option '{}'; the measure has none", option)
                              : fmt::format("there is no option '{}'{}", option, base::DidYouMean(option, names)),
                          info.name);
}

base::Status CheckBaseline(const MeasuresSpec& spec) {
  if (spec.baseline.empty()) return {};
  std::vector<std::string> names;
  for (const IntervalSpec& interval : spec.intervals) names.push_back(interval.name);
  const auto found = std::ranges::find(names, spec.baseline);
  if (found == names.end()) {
    return base::WrongInput("measure.unknown_interval",
                            fmt::format("there is no interval '{}'{}", spec.baseline,
                                        names.empty() ? "" : base::DidYouMean(spec.baseline, names)));
  }
  if (!spec.intervals[static_cast<std::size_t>(found - names.begin())].condition) return {};
  return base::WrongInput(
      "measure.wrong_baseline",
      fmt::format("interval '{}' has a condition, so there may be several; an interval by times was expected",
                  spec.baseline));
}

base::Result<MeasuresSpec> ReadSpec(const std::filesystem::path& path) {
  const auto file = config::File::Load(path);
  if (!file) return file.error();
  const config::Map root = file.value().root();
  const config::DeclaredMap declared(root, MeasuresSchema().keys);
  (void)declared.Word("rodeira");
  MeasuresSpec spec = DefaultSpec();
  spec.subject = declared.Text("subject", "");
  spec.baseline = declared.Text("baseline", "");
  ReadIntervals(declared, spec);
  ReadMeasures(declared, spec);
  ReadLaneChangeTest(declared, spec.lane_change_test);
  ReadOptions(declared, spec);
  root.IgnoreKey("recordings");  // a sidecar lists what its table was made of
  root.IgnoreKey("version");
  root.IgnoreKey("values");
  if (auto status = CheckBaseline(spec); !status) root.Problem("baseline", status.error().id, status.error().message);
  if (auto status = file.value().Finish(); !status) return status.error();
  return spec;
}

std::vector<MeasuresRow> ComputeRows(const MeasuresSpec& spec, const DriveReading& reading) {
  const Drive& drive = reading.drive;
  const double end_s = static_cast<double>(drive.size()) / drive.rate_hz;
  std::vector<IntervalSpec> intervals = spec.intervals;
  if (intervals.empty()) intervals.push_back(WholeRecording());
  std::optional<std::pair<std::size_t, std::size_t>> baseline;
  for (const IntervalSpec& interval : intervals) {
    if (spec.baseline.empty() || interval.name != spec.baseline) continue;
    baseline = SamplesOf(FindInterval(interval, reading.events, end_s), drive.rate_hz, drive.size());
  }
  std::vector<MeasuresRow> rows;
  static const std::map<std::string, double> kNone;
  std::vector<Interval> found;
  for (const IntervalSpec& asked : intervals)
    std::ranges::move(FindIntervals(asked, reading), std::back_inserter(found));
  for (Interval& interval : found) {
    MeasuresRow row;
    row.interval = std::move(interval);
    const auto [from, to] = SamplesOf(row.interval, drive.rate_hz, drive.size());
    for (const MeasureInfo* info : spec.measures) {
      if (!row.interval.reason.empty()) {
        Measure missing;
        missing.reason = row.interval.reason;
        row.values.push_back(std::move(missing));
        continue;
      }
      const auto given = spec.options.find(info->name);
      row.values.push_back(info->compute({drive, from, to, baseline, &spec.lane_change_test},
                                         {info->options, given == spec.options.end() ? kNone : given->second}));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace rodeira::measures
