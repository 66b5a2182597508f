// SPDX-License-Identifier: Apache-2.0
// Lane changes as half a cosine beside vehicles at constant speeds: all times are closed forms.
#include "common/analysis/measures/lane_change_conflict.hpp"

#include <gtest/gtest.h>

#include "common/analysis/measures/catalogue.hpp"
#include "common/analysis/measures/given_drive.hpp"
#include "tests/common/analysis/measures/signals.hpp"

namespace rodeira::measures {
namespace {

constexpr double kRate = 100.0, kOwn = 25.0, kFrom = 4.0, kTakes = 5.0, kLane = 3.5;

// The lateral speed of the change is 0.1 m/s so long after its beginning, and before its end.
const double kOnset_s = kTakes / std::numbers::pi * std::asin(0.1 * kTakes / (0.5 * kLane * std::numbers::pi));

// From the middle of one lane to the middle of the next one. The leader is `leader` ahead and slower by 5 m/s, the lag
// closes in by `closing` and would be there at `meets`.
GivenDrive Change(bool left, double closing, double meets) {
  GivenDrive given;
  given.rate_hz = kRate;
  auto& c = given.columns;
  for (int k = 0; k < 1500; ++k) {
    const double t = k / kRate, done = std::clamp((t - kFrom) / kTakes, 0.0, 1.0);
    const double across = kLane * 0.5 * (1.0 - std::cos(std::numbers::pi * done));
    const bool over = across > 0.5 * kLane;
    c["lane_position_m"].push_back((left ? 1.0 : -1.0) * (over ? across - kLane : across));
    c["lane_width_m"].push_back(kLane);
    c["speed_mps"].push_back(kOwn);
    c["leader_gap_m"].push_back(over ? 120.0 : 60.0 - 5.0 * t);
    c["leader_speed_mps"].push_back(over ? kOwn + 3.0 : kOwn - 5.0);
    const double lag = closing * (meets - t);
    c[left ? "left_follower_gap_m" : "right_follower_gap_m"].push_back(over ? kMissing : lag);
    c[left ? "left_follower_speed_mps" : "right_follower_speed_mps"].push_back(over ? kMissing : kOwn + closing);
    c["follower_gap_m"].push_back(over ? lag : 8.0);
    c["follower_speed_mps"].push_back(over ? kOwn + closing : kOwn);
  }
  return given;
}

Measure ValueOf(const char* name, const GivenDrive& given, const std::map<std::string, double>& options = {}) {
  const Drive drive = DriveOf(given).value();
  const MeasureInfo& info = *FindMeasure(name).value();
  return info.compute({drive, 0, drive.size(), {}}, OptionValues(info.options, options));
}

// Urgency: the leader that is left is 60 - 5 t ahead, TTC = 12 - t, at the begin. Severity: the lag's TTC is
// meets - t, least at the end.
TEST(LaneChangeConflict, UrgencyAndSeverityOfOneChange) {
  for (const bool left : {true, false}) {
    const GivenDrive given = Change(left, 8.0, 12.5);
    const Measure urgency = ValueOf("lane_change_urgency_s", given);
    EXPECT_NEAR(*urgency.value, 12.0 - (kFrom + kOnset_s), 0.02);
    EXPECT_EQ(urgency.n, 1u);
    const Measure severity = ValueOf("lane_change_severity_s", given);
    EXPECT_NEAR(*severity.value, 12.5 - (kFrom + kTakes - kOnset_s), 0.02);
    EXPECT_EQ(ValueOf("lane_changes_n", given).value, 1.0);
  }
}

// The limits by closing speed: up to 10, 15 and 20 m/s a TTC of 2.5, 3.0 and 3.5 s. At the end of the change the lag is
// 2.7 s away, or 3.3 s.
TEST(LaneChangeConflict, TheLimitOfALagGrowsWithItsClosingSpeed) {
  const double end = kFrom + kTakes - kOnset_s;
  const auto conflicts = [&](double closing, double ttc_s, const std::map<std::string, double>& options = {}) {
    return *ValueOf("lane_change_lag_conflicts_n", Change(true, closing, end + ttc_s), options).value;
  };
  const double cases[][3] = {{8.0, 2.7, 0.0},  {10.0, 2.7, 0.0}, {10.5, 2.7, 1.0}, {12.0, 3.3, 0.0}, {15.0, 3.3, 0.0},
                             {15.5, 3.3, 1.0}, {8.0, 2.3, 1.0},  {18.0, 3.7, 0.0}, {28.0, 3.3, 1.0}, {28.0, 3.7, 0.0}};
  for (const auto& [closing, ttc_s, expected] : cases) EXPECT_EQ(conflicts(closing, ttc_s), expected) << closing;
  EXPECT_EQ(conflicts(8.0, 2.7, {{"ttc_10_s", 3.0}}), 1.0);
}

// A lag that is slower is no conflict, unless it is beside; without a lag or a leader there is no value, and its
// reason.
TEST(LaneChangeConflict, ALagBesideAndNobody) {
  GivenDrive slow = Change(true, -2.0, -5.0);
  EXPECT_EQ(ValueOf("lane_change_severity_s", slow).reason, "no lag closes in");
  EXPECT_EQ(ValueOf("lane_change_lag_conflicts_n", slow).value, 0.0);
  for (double& gap : slow.columns["left_follower_gap_m"]) gap = gap > 22.0 ? gap : -1.0;
  EXPECT_EQ(ValueOf("lane_change_severity_s", slow).value, 0.0);
  EXPECT_EQ(ValueOf("lane_change_lag_conflicts_n", slow).value, 1.0);
  for (const char* column : {"leader_gap_m", "left_follower_gap_m", "follower_gap_m"}) slow.columns.erase(column);
  EXPECT_EQ(ValueOf("lane_change_urgency_s", slow).reason, "no leader is closed in on");
  EXPECT_EQ(ValueOf("lane_change_severity_s", slow).reason, "no lag closes in");
  EXPECT_EQ(ValueOf("lane_change_lag_conflicts_n", slow).value, 0.0);
}

TEST(LaneChangeConflict, WithoutAChangeOrALane) {
  GivenDrive given = Change(true, 8.0, 12.5);
  given.columns["lane_position_m"].assign(1500, 0.0);
  for (const char* name : {"lane_change_urgency_s", "lane_change_severity_s"})
    EXPECT_EQ(ValueOf(name, given).reason, "no lane change");
  EXPECT_EQ(ValueOf("lane_change_lag_conflicts_n", given).value, 0.0);
  given.columns["lane_position_m"].assign(1500, kMissing);
  EXPECT_EQ(ValueOf("lane_change_lag_conflicts_n", given).reason, "no sample with a lane position");
}

}  // namespace
}  // namespace rodeira::measures
