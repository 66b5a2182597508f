// SPDX-License-Identifier: Apache-2.0
// Gaps in a stream that crosses the path: a driver arrives at the line, lets some pass and goes.
#include "common/analysis/measures/offered_gaps.hpp"

#include <gtest/gtest.h>

#include "common/analysis/measures/catalogue.hpp"
#include "tests/common/analysis/measures/signals.hpp"

namespace rodeira::measures {
namespace {

constexpr double kRate = 100.0;

// A drive of 60 s along x: to a standstill at 10 s, from `goes_s` on through a junction that begins at 50 m and is 20 m
// long. Its front is 2 m before the reference point.
Drive DriveThrough(double goes_s) {
  Drive d;
  d.rate_hz = kRate;
  GrowColumns(d, 6000);
  d.front_m = 2.0;
  d.length_m = 4.0;
  d.width_m = 1.8;
  for (std::size_t k = 0; k < d.size(); ++k) {
    const double t = static_cast<double>(k) / kRate;
    d.x_m[k] = t < 10.0 ? 4.6 * t : 46.0 + 5.0 * std::max(0.0, t - goes_s);
    d.y_m[k] = 0.0;
    d.junction[k] = d.x_m[k] >= 50.0 && d.x_m[k] < 70.0 ? 1.0 : 0.0;
  }
  return d;
}

// A vehicle of the stream is in the common area from one time to the other; the driver enters it at `own_s`.
Encounter Passes(std::int64_t id, double from_s, double to_s, double own_s) {
  return {id, 1.57, own_s, own_s + 1.5, from_s, to_s};
}

Measure ValueOf(const Drive& d, const char* name, std::size_t from = 0, std::size_t to = 6000) {
  const MeasureInfo* info = FindMeasure(name).value();
  return info->compute({d, from, to, std::nullopt}, {info->options, {}});
}

// The front is 5 m before the junction when B is at 43 m, after 9.35 s. Vehicles from 12 to 13 s, 15 to 16 s and 21 to
// 22 s; the driver goes at 22 s, and the next one comes at 29 s.
TEST(OfferedGaps, LagAndGapsAtAJunction) {
  Drive d = DriveThrough(22.0);
  d.encounters = {Passes(1, 4.0, 5.0, 23.0), Passes(2, 12.0, 13.0, 23.0), Passes(3, 15.0, 16.0, 23.0),
                  Passes(4, 21.0, 22.0, 23.0), Passes(5, 29.0, 30.0, 23.0)};
  const auto gaps = FindOfferedGaps(d, {});
  ASSERT_EQ(gaps.size(), 1u);
  ASSERT_EQ(gaps[0].rejected_s.size(), 3u);
  EXPECT_NEAR(gaps[0].rejected_s[0], 12.0 - 43.0 / 4.6, 0.011);  // the lag
  EXPECT_NEAR(gaps[0].rejected_s[1], 2.0, 1e-9);
  EXPECT_NEAR(gaps[0].rejected_s[2], 5.0, 1e-9);
  ASSERT_TRUE(gaps[0].accepted_s);
  EXPECT_NEAR(*gaps[0].accepted_s, 7.0, 1e-9);
  EXPECT_EQ(FindOfferedGaps(d, {.with_lags = false})[0].rejected_s.size(), 2u);
  EXPECT_EQ(*ValueOf(d, "gaps_accepted_n").value, 1.0);
  EXPECT_EQ(*ValueOf(d, "gaps_rejected_n").value, 3.0);
  EXPECT_NEAR(*ValueOf(d, "gap_accepted_min_s").value, 7.0, 1e-9);
  EXPECT_NEAR(*ValueOf(d, "gap_rejected_max_s").value, 5.0, 1e-9);
  EXPECT_NEAR(*ValueOf(d, "critical_gap_raff_s").value, 6.0, 1e-9);
  // The interval without the driver's entry at 23 s has none of them.
  EXPECT_EQ(*ValueOf(d, "gaps_rejected_n", 0, 2300).value, 0.0);
  EXPECT_EQ(ValueOf(d, "gap_accepted_min_s", 0, 2300).reason, "no gap was accepted");
  EXPECT_EQ(*ValueOf(d, "gaps_rejected_n", 2300, 6000).value, 3.0);
}

// Two lanes: vehicles that pass at one time are one occupancy; a gap counts from the rear of the last one.
TEST(OfferedGaps, TwoStreams) {
  Drive d = DriveThrough(22.0);
  d.encounters = {Passes(1, 12.0, 14.0, 23.0), Passes(2, 13.0, 13.5, 24.0), Passes(3, 18.0, 19.0, 24.0),
                  Passes(4, 26.0, 27.0, 24.0)};
  const auto gaps = FindOfferedGaps(d, {.with_lags = false});
  ASSERT_EQ(gaps.size(), 1u);
  EXPECT_EQ(gaps[0].rejected_s, std::vector<double>{4.0});
  EXPECT_NEAR(*gaps[0].accepted_s, 7.0, 1e-9);
}

// Without a next vehicle nothing is accepted; of a driver that goes at once the lag is. Beside junctions there are no
// gaps, and without roads, or without the others' paths, nothing is known.
TEST(OfferedGaps, WhatIsMissingHasItsReason) {
  Drive d = DriveThrough(22.0);
  d.encounters = {Passes(1, 12.0, 13.0, 23.0)};
  EXPECT_FALSE(FindOfferedGaps(d, {})[0].accepted_s);
  EXPECT_EQ(ValueOf(d, "gap_accepted_min_s").reason, "no gap was accepted");
  EXPECT_FALSE(ValueOf(d, "critical_gap_ml_s").value);
  Drive at_once = DriveThrough(10.0);
  at_once.encounters = {Passes(1, 15.0, 16.0, 11.0)};
  EXPECT_NEAR(*FindOfferedGaps(at_once, {})[0].accepted_s, 15.0 - 43.0 / 4.6, 0.011);
  EXPECT_TRUE(FindOfferedGaps(at_once, {.max_gap_s = 5.0}).empty());
  d.encounters = {Passes(1, 40.0, 41.0, 42.0)};  // far beyond the junction
  EXPECT_EQ(*ValueOf(d, "gaps_rejected_n").value, 0.0);
  EXPECT_EQ(ValueOf(d, "gap_rejected_max_s").reason, "no gap was rejected");
  d.encounters.reset();
  EXPECT_EQ(ValueOf(d, "gaps_rejected_n").reason, "the paths of other vehicles are not known");
  EXPECT_EQ(ValueOf(d, "pet_min_s").reason, "the paths of other vehicles are not known");
  d.encounters.emplace();
  std::ranges::fill(d.junction, kMissing);
  EXPECT_EQ(ValueOf(d, "gaps_accepted_n").reason, "no sample is on a road");
}

// An encounter counts where its second vehicle enters, [from, to).
TEST(OfferedGaps, PostEncroachmentTimesOfAnInterval) {
  Drive d = DriveThrough(22.0);
  d.encounters = {Passes(1, 19.5, 20.5, 23.0), Passes(2, 31.0, 32.0, 26.0), Passes(3, 41.0, kMissing, 42.0)};
  EXPECT_NEAR(*ValueOf(d, "pet_min_s").value, 2.5, 1e-9);
  EXPECT_EQ(ValueOf(d, "pet_min_s").n, 2u);
  EXPECT_NEAR(*ValueOf(d, "pet_min_s", 2301, 6000).value, 3.5, 1e-9);
  EXPECT_EQ(ValueOf(d, "pet_min_s", 0, 2300).reason, "no vehicle crosses or joins the path");
  EXPECT_EQ(*ValueOf(d, "pet_conflicts_n").value, 0.0);
  d.encounters->front().other_leaves_s = 21.5;
  EXPECT_EQ(*ValueOf(d, "pet_conflicts_n").value, 1.0);
}

}  // namespace
}  // namespace rodeira::measures
