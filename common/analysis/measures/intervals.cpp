// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/intervals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "common/core/base/suggest.hpp"

namespace rodeira::measures {
namespace {

constexpr const char* kPoints = "start, end, seconds, mark:TEXT or event:NAME was expected";

std::optional<double> SecondsIn(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string NameOf(const TimePoint& point) {
  const char* what = point.kind == TimePoint::Kind::kMark ? "mark" : "event";
  std::string name = fmt::format("{} '{}'", what, point.name);
  if (!point.argument.empty()) name += fmt::format(" of '{}'", point.argument);
  if (point.number > 1) name += fmt::format(" number {}", point.number);
  return name;
}

// The time of a point; nothing, and the reason, where the recording has none.
std::optional<double> TimeOf(const TimePoint& point, std::span<const DriveEvent> events, double end_s,
                             Interval& interval) {
  if (point.kind == TimePoint::Kind::kStart) return 0.0;
  if (point.kind == TimePoint::Kind::kEnd) return end_s;
  if (point.kind == TimePoint::Kind::kSeconds) return point.seconds;
  const auto kind = point.kind == TimePoint::Kind::kMark ? DriveEvent::Kind::kMark : DriveEvent::Kind::kScenario;
  int number = 0;
  std::vector<std::string> names;
  for (const DriveEvent& event : events) {
    if (event.kind != kind) continue;
    if (std::ranges::find(names, event.name) == names.end()) names.push_back(event.name);
    if (event.name != point.name || (!point.argument.empty() && event.argument != point.argument)) continue;
    if (++number == point.number) return event.time_s;
  }
  interval.unknown = number == 0;
  interval.reason = fmt::format("the recording has no {}", NameOf(point));
  if (interval.unknown) {
    const char* none = point.kind == TimePoint::Kind::kMark ? "; it has no marks" : "; it has no events of a scenario";
    interval.reason += names.empty() ? none : base::DidYouMean(point.name, names);
  }
  return std::nullopt;
}

}  // namespace

base::Result<TimePoint> ParseTimePoint(std::string_view text) {
  TimePoint point;
  if (text == "start") return point;
  point.kind = TimePoint::Kind::kEnd;
  if (text == "end") return point;
  if (const auto seconds = SecondsIn(text)) {
    point.kind = TimePoint::Kind::kSeconds;
    point.seconds = *seconds;
    if (*seconds < 0.0)
      return base::WrongInput("measure.wrong_interval", fmt::format("'{}' is before the start", text));
    return point;
  }
  const bool mark = text.starts_with("mark:"), event = text.starts_with("event:");
  std::string_view name = mark || event ? text.substr(text.find(':') + 1) : std::string_view();
  if (name.empty())
    return base::WrongInput("measure.wrong_interval", fmt::format("'{}' is no point in time; {}", text, kPoints));
  point.kind = mark ? TimePoint::Kind::kMark : TimePoint::Kind::kEvent;
  if (const auto hash = name.rfind('#'); hash != std::string_view::npos && hash > 0) {
    const auto number = SecondsIn(name.substr(hash + 1));
    if (number && *number >= 1.0 && *number < 1e6 && *number == std::floor(*number)) {
      point.number = static_cast<int>(*number);
      name = name.substr(0, hash);
    }
  }
  if (const auto colon = name.find(':'); event && colon != std::string_view::npos) {
    point.argument = std::string(name.substr(colon + 1));
    name = name.substr(0, colon);
  }
  point.name = std::string(name);
  return point;
}

base::Result<IntervalSpec> ParseInterval(std::string_view text) {
  constexpr std::string_view kWhile = "while ";
  const auto equals = text.find('='), dots = text.find("..");
  if (equals != std::string_view::npos && equals != 0 && text.substr(equals + 1).starts_with(kWhile)) {
    IntervalSpec spec;
    spec.name = std::string(text.substr(0, equals));
    spec.to.kind = TimePoint::Kind::kEnd;
    auto condition = ParseCondition(text.substr(equals + 1 + kWhile.size()));
    if (!condition) return condition.error().In(fmt::format("interval '{}'", spec.name));
    spec.condition = std::move(condition).value();
    if (auto status = CheckInterval(spec); !status) return status.error();
    return spec;
  }
  if (equals == std::string_view::npos || equals == 0 || dots == std::string_view::npos || dots < equals) {
    return base::WrongInput(
        "measure.wrong_interval",
        fmt::format("'{}' is no interval; NAME=FROM..TO was expected, as task=mark:begin..+20, or NAME=while "
                    "CONDITION, as fast=while speed_mps > 20",
                    text));
  }
  IntervalSpec spec;
  spec.name = std::string(text.substr(0, equals));
  auto from = ParseTimePoint(text.substr(equals + 1, dots - equals - 1));
  if (!from) return from.error().WithContext(fmt::format("interval '{}'", spec.name));
  spec.from = std::move(from).value();
  const std::string_view to = text.substr(dots + 2);
  if (to.starts_with('+')) {
    spec.for_s = SecondsIn(to.substr(1));
    if (!spec.for_s)
      return base::WrongInput("measure.wrong_interval", fmt::format("'{}' is no number of seconds", to),
                              fmt::format("interval '{}'", spec.name));
  } else {
    auto end = ParseTimePoint(to);
    if (!end) return end.error().WithContext(fmt::format("interval '{}'", spec.name));
    spec.to = std::move(end).value();
  }
  if (auto status = CheckInterval(spec); !status) return status.error();
  return spec;
}

base::Status CheckInterval(const IntervalSpec& spec) {
  if (const auto hash = spec.name.rfind('#'); hash != std::string::npos && SecondsIn(spec.name.substr(hash + 1)))
    return base::WrongInput("measure.wrong_interval",
                            fmt::format("an interval is named '{}'; a name without a number behind '#' was expected, "
                                        "which numbers the times of a condition",
                                        spec.name));
  const bool times = spec.from.kind == TimePoint::Kind::kSeconds && spec.to.kind == TimePoint::Kind::kSeconds;
  const bool empty = spec.for_s
                         ? !(*spec.for_s > 0.0)
                         : (times && spec.to.seconds <= spec.from.seconds) || spec.to.kind == TimePoint::Kind::kStart ||
                               spec.from.kind == TimePoint::Kind::kEnd;
  if (!empty) return {};
  return base::WrongInput("measure.wrong_interval",
                          fmt::format("interval '{}' is empty: its end must be later than its begin", spec.name));
}

Interval FindInterval(const IntervalSpec& spec, std::span<const DriveEvent> events, double end_s) {
  Interval interval{spec.name, kMissing, kMissing, {}, false};
  const auto from = TimeOf(spec.from, events, end_s, interval);
  if (!from) return interval;
  interval.from_s = *from;
  const auto to = spec.for_s ? std::optional(*from + *spec.for_s) : TimeOf(spec.to, events, end_s, interval);
  if (!to) return interval;
  interval.to_s = std::min(*to, end_s);
  if (interval.from_s >= end_s)
    interval.reason = fmt::format("it begins at {:g} s, but the recording ends at {:g} s", *from, end_s);
  else if (interval.to_s <= interval.from_s)
    interval.reason = fmt::format("it is empty: from {:g} s to {:g} s", interval.from_s, interval.to_s);
  return interval;
}

std::vector<Interval> FindIntervals(const IntervalSpec& spec, const DriveReading& reading) {
  const Drive& drive = reading.drive;
  Interval whole = FindInterval(spec, reading.events, static_cast<double>(drive.size()) / drive.rate_hz);
  if (!spec.condition || !whole.reason.empty()) return {whole};
  Condition condition = *spec.condition;
  if (std::string reason = condition.FindRoads(reading.roads); !reason.empty()) {
    whole.from_s = whole.to_s = kMissing;
    whole.reason = std::move(reason);
    whole.unknown = true;
    return {whole};
  }
  const auto [from, to] = SamplesOf(whole, drive.rate_hz, drive.size());
  std::vector<Interval> intervals;
  std::size_t all = 0;
  for (const auto& [begin, end] : SamplesWhile(condition, drive, from, to)) {
    ++all;
    if (static_cast<double>(end - begin) < spec.min_s * drive.rate_hz - 1e-6) continue;
    Interval interval = whole;
    interval.from_s = static_cast<double>(begin) / drive.rate_hz;
    interval.to_s = static_cast<double>(end) / drive.rate_hz;
    if (!intervals.empty()) interval.name += fmt::format("#{}", intervals.size() + 1);
    intervals.push_back(std::move(interval));
  }
  if (!intervals.empty()) return intervals;
  whole.from_s = whole.to_s = kMissing;
  whole.reason = all == 0
                     ? fmt::format("'{}' never holds from {:g} s to {:g} s", spec.condition->text,
                                   static_cast<double>(from) / drive.rate_hz, static_cast<double>(to) / drive.rate_hz)
                     : fmt::format("'{}' never holds for {:g} s", spec.condition->text, spec.min_s);
  return {whole};
}

std::pair<std::size_t, std::size_t> SamplesOf(const Interval& interval, double rate_hz, std::size_t size) {
  const auto at = [&](double time_s) {
    // A time that is a sample's but for rounding is that sample's.
    const double k = std::ceil(time_s * rate_hz - 1e-6);
    return static_cast<std::size_t>(std::clamp(k, 0.0, static_cast<double>(size)));
  };
  if (!interval.reason.empty()) return {0, 0};
  return {at(interval.from_s), at(interval.to_s)};
}

}  // namespace rodeira::measures
