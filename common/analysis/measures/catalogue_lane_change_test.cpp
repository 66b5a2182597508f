// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/catalogue.hpp"
#include "common/analysis/measures/lane_change_test.hpp"
#include "common/analysis/measures/statistics.hpp"

namespace rodeira::measures {
namespace {

constexpr const char* kFamily = "lane-change test";
constexpr const char* kSource = "ISO 26022";
constexpr const char* kStretchTraps =
    "mean over distance, not time; against the road's stations it is missing; long drives in a wrong lane dominate";

// Stations of the cut, missing on other roads than the test's.
std::vector<double> StationsIn(const DriveCut& cut, std::size_t from, std::size_t to) {
  const Series s = Part(cut.drive.s_m, from, to), road = Part(cut.drive.road, from, to);
  std::vector<double> stations(s.begin(), s.end());
  const auto& wanted = cut.lane_change_test->road;
  for (std::size_t i = 0; i < stations.size() && wanted; ++i) {
    if (road[i] != *wanted) stations[i] = kMissing;
  }
  return stations;
}

Measure WithoutTest(const DriveCut& cut, const char* unit) {
  return NotFound("there are no signs (lane_change_test of a measures file)", unit, 0, cut.to - cut.from);
}
bool HasTest(const DriveCut& cut) { return cut.lane_change_test != nullptr && !cut.lane_change_test->signs.empty(); }

Measure DeviationFrom(const ReferencePath& path, const DriveCut& cut, const OptionValues& o) {
  const LaneChangeTest& test = *cut.lane_change_test;
  return MeanDeviation(StationsIn(cut, cut.from, cut.to), cut(cut.drive.t_m), test.signs.front().s_m - o["run_in_m"],
                       test.signs.back().s_m + o["run_out_m"], test.signs, path);
}

Measure BasicDeviation(const DriveCut& cut, const OptionValues& o) {
  if (!HasTest(cut)) return WithoutTest(cut, "m");
  return DeviationFrom({o["before_m"], o["length_m"], cut.lane_change_test->start_t_m}, cut, o);
}

Measure DeviationInCorrectLanes(const DriveCut& cut, const OptionValues& o) {
  if (!HasTest(cut)) return WithoutTest(cut, "m");
  return CorrectDeviation(StationsIn(cut, cut.from, cut.to), cut(cut.drive.t_m), *cut.lane_change_test,
                          {o["before_m"], o["length_m"], cut.lane_change_test->start_t_m}, o["half_lane_m"], o["by_m"],
                          o["run_in_m"], o["run_out_m"]);
}

Measure DelayOfChanges(const DriveCut& cut, const OptionValues& o) {
  if (!HasTest(cut)) return WithoutTest(cut, "s");
  return ChangeDelay(StationsIn(cut, cut.from, cut.to), cut(cut.drive.t_m), cut.drive.rate_hz, *cut.lane_change_test,
                     o["legible_m"]);
}

Measure AdaptiveDeviation(const DriveCut& cut, const OptionValues& o) {
  if (!HasTest(cut)) return WithoutTest(cut, "m");
  if (!cut.baseline) return NotFound("no interval is named as the baseline", "m", 0, cut.to - cut.from);
  const auto [from, to] = *cut.baseline;
  const OwnPath own = FindOwnPath(StationsIn(cut, from, to), Part(cut.drive.t_m, from, to), *cut.lane_change_test);
  if (own.changes == 0) return NotFound("the baseline has no lane change at a sign", "m", 0, cut.to - cut.from);
  Measure measure = DeviationFrom(own.path, cut, o);
  measure.options.push_back({"baseline_changes", std::to_string(own.changes)});
  return measure;
}

Measure CorrectShare(const DriveCut& cut, const OptionValues& o) {
  if (!HasTest(cut)) return WithoutTest(cut, "1");
  return CorrectChanges(StationsIn(cut, cut.from, cut.to), cut(cut.drive.t_m), cut.lane_change_test->signs,
                        o["half_lane_m"], o["by_m"]);
}

}  // namespace

std::vector<MeasureInfo> LaneChangeTestMeasures() {
  const OptionInfo run_in{"run_in_m", 50, 0, 1000, "of the stretch, before the first sign"},
      run_out{"run_out_m", 50, 0, 1000, "of the stretch, behind the last sign"},
      before{"before_m", 30, 0, 200, "begin of a change, before its sign"},
      length{"length_m", 10, 0.1, 200, "of a change"}, half_lane{"half_lane_m", 1.75, 0.1, 10, "the lane is reached"},
      by{"by_m", 40, 0, 500, "behind the sign"};
  return {
      {"lct_mdev_m",
       kFamily,
       "mean deviation from the basic path",
       "(1/L) integral of |t - t_ref| ds; t_ref changes lanes on a straight line",
       kStretchTraps,
       kSource,
       {before, length, run_in, run_out},
       BasicDeviation},
      {"lct_mdev_correct_m",
       kFamily,
       "mean deviation from the basic path, without wrong lanes",
       "the same over the signs with the demanded lane reached, up to the change of the next sign",
       "mean over distance, not time; it and lct_mdev_m belong together",
       kSource,
       {before, length, half_lane, by, run_in, run_out},
       DeviationInCorrectLanes},
      {"lct_mdev_adaptive_m",
       kFamily,
       "mean deviation from the person's own path",
       "the same with begin and length of the changes in the baseline (10 % to 90 % of a change)",
       kStretchTraps,
       kSource,
       {run_in, run_out},
       AdaptiveDeviation},
      {"lct_correct_share",
       kFamily,
       "share of signs with the demanded lane reached",
       "signs with |t - t_sign| < half a lane, by a distance behind them / signs that are passed",
       "the lane at one place counts, not how it was reached",
       kSource,
       {half_lane, by},
       CorrectShare},
      {"lct_delay_s",
       kFamily,
       "mean delay of the changes after their signs can be read",
       "mean time from legible_m before a sign to the begin of its change (straight line through 10 % and 90 %)",
       "signs without a change are left out; the distance of reading is the study's",
       kSource,
       {{"legible_m", 40, 0, 500, "before the sign"}},
       DelayOfChanges},
  };
}

}  // namespace rodeira::measures
