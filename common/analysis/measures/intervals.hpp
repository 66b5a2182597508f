// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/analysis/measures/condition.hpp"
#include "common/analysis/measures/drive_reader.hpp"
#include "common/core/base/result.hpp"

namespace rodeira::measures {

// A point in time: "start", "end", seconds ("12.5"), "mark:TEXT", "event:NAME" or "event:NAME:ARGUMENT"; the second
// mark or event of that name: "mark:TEXT#2".
struct TimePoint {
  enum class Kind { kStart, kEnd, kSeconds, kMark, kEvent } kind = Kind::kStart;
  double seconds = 0.0;
  std::string name, argument;
  int number = 1;
};
// Wrong input where the text is none of these.
base::Result<TimePoint> ParseTimePoint(std::string_view text);

// A part of each recording, as it is asked for.
struct IntervalSpec {
  std::string name;
  TimePoint from;
  TimePoint to;                 // does not count where there is a duration
  std::optional<double> for_s;  // from `from` on
  // Only while this holds; each time that it does is an interval of its own.
  std::optional<Condition> condition;
  double min_s = 0.0;  // shorter times of the condition are left out
};
// "NAME=FROM..TO", where TO may be "+SECONDS", or "NAME=while CONDITION". Wrong input where it is none, or empty
// whatever the recording is.
base::Result<IntervalSpec> ParseInterval(std::string_view text);
// Wrong input where the interval is empty whatever the recording is.
base::Status CheckInterval(const IntervalSpec& spec);

// The part of one recording: the samples with from_s <= t < to_s, so that neighbours add up.
struct Interval {
  std::string name;
  double from_s = 0.0, to_s = 0.0;
  std::string reason;    // why there is none in this recording; empty: there is
  bool unknown = false;  // a mark, event or road of that name is not there at all
};
// end_s: the time behind the last sample. An interval that goes on beyond it ends there.
Interval FindInterval(const IntervalSpec& spec, std::span<const DriveEvent> events, double end_s);
// The intervals of a recording by their times: one, or one each time that the condition holds, the second one named
// "NAME#2". At least one: without any, it has the reason. A gap in the recording ends an interval.
std::vector<Interval> FindIntervals(const IntervalSpec& spec, const DriveReading& reading);
// The samples of it, [first, second).
std::pair<std::size_t, std::size_t> SamplesOf(const Interval& interval, double rate_hz, std::size_t size);

}  // namespace rodeira::measures
