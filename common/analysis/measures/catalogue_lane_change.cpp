// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "common/analysis/measures/catalogue.hpp"
#include "common/analysis/measures/lane_change_conflict.hpp"
#include "common/analysis/measures/statistics.hpp"

namespace rodeira::measures {
namespace {

const OptionInfo kChangeOnset{"onset_mps", 0.1, 0.001, 10, "a lane change begins and ends below this lateral speed"};

std::vector<LaneChangeConflict> ConflictsIn(const DriveCut& cut, const OptionValues& o, const LagLimits& limits) {
  const auto crossing = std::span(cut.drive.crossing).subspan(cut.from, cut.to - cut.from);
  const auto changes =
      LaneChanges(cut(cut.drive.lane_position_m), crossing, cut.drive.rate_hz, {.onset_mps = o["onset_mps"]});
  return ConflictsOf(cut.drive, cut.from, changes, limits);
}

// n counts the changes with a value, the valid share the samples with a lane.
Measure OfChanges(const DriveCut& cut, Measure measure, const UsedOptions& used, std::size_t changes) {
  const std::size_t all = cut.to - cut.from, valid = CountValid(cut(cut.drive.lane_position_m));
  if (valid == 0) return NotFound("no sample with a lane position", measure.unit.c_str(), 0, all, used);
  if (!measure.value && changes == 0) measure.reason = "no lane change";
  measure.valid_share = static_cast<double>(valid) / static_cast<double>(all);
  measure.options = used;
  return measure;
}

template <double LaneChangeConflict::*Time>
Measure LeastTime(const DriveCut& cut, const OptionValues& o) {
  const auto conflicts = ConflictsIn(cut, o, {});
  std::vector<double> times;
  for (const LaneChangeConflict& conflict : conflicts) times.push_back(conflict.*Time);
  const bool leader = Time == &LaneChangeConflict::leader_ttc_s;
  return OfChanges(cut,
                   FoundOr(Minimum(times), leader ? "no leader is closed in on" : "no lag closes in", "s",
                           CountValid(times), times.size()),
                   Used({{"onset_mps", o["onset_mps"]}, {"at", leader ? "begin" : "begin to end"}}), conflicts.size());
}

Measure LagConflicts(const DriveCut& cut, const OptionValues& o) {
  const LagLimits limits{o["ttc_10_s"], o["ttc_15_s"], o["ttc_20_s"]};
  const auto conflicts = ConflictsIn(cut, o, limits);
  const auto near = std::ranges::count(conflicts, true, &LaneChangeConflict::lag_too_near);
  return OfChanges(cut, Found(static_cast<double>(near), "1", conflicts.size(), conflicts.size()),
                   Used({{"onset_mps", o["onset_mps"]},
                         {"ttc_10_s", limits.ttc_10_s},
                         {"ttc_15_s", limits.ttc_15_s},
                         {"ttc_20_s", limits.ttc_20_s}}),
                   conflicts.size());
}

}  // namespace

std::vector<MeasureInfo> LaneChangeMeasures() {
  const char* family = "lane";
  return {
      {"lane_change_urgency_s",
       family,
       "least time to collision with the leader at the begin of a lane change",
       "min over the changes of gap / (v - v_leader) at the begin, in the lane that is left",
       "a time, without the classes of the standard's scale; missing, never 0, where no leader is closed in on",
       "SAE J2944 10.4.4",
       {kChangeOnset},
       LeastTime<&LaneChangeConflict::leader_ttc_s>},
      {"lane_change_severity_s",
       family,
       "least time to collision of the lag during a lane change",
       "min from begin to end of gap / (v_lag - v); lag: the follower in the lane that is entered",
       "a time, without the classes of the standard's scale; missing where no lag closes in; 0: it is beside",
       "SAE J2944 10.4.5",
       {kChangeOnset},
       LeastTime<&LaneChangeConflict::lag_ttc_s>},
      {"lane_change_lag_conflicts_n",
       family,
       "number of lane changes with a lag that is too near",
       "changes with a sample in which the lag's time to collision is below the limit of its closing speed",
       "limits as told of the edition of 2008, not read in the standard; a faster lag than 20 m/s has the last one",
       "ISO 17387",
       {kChangeOnset,
        {"ttc_10_s", 2.5, 0, 60, "limit of a lag that closes in by 10 m/s at most (class A)"},
        {"ttc_15_s", 3.0, 0, 60, "by 15 m/s at most (class B)"},
        {"ttc_20_s", 3.5, 0, 60, "faster (class C: 20 m/s)"}},
       LagConflicts},
  };
}

}  // namespace rodeira::measures
