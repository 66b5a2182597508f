// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/condition.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/analysis/measures/intervals.hpp"
#include "tests/common/analysis/measures/signals.hpp"

namespace rodeira::measures {
namespace {

constexpr double kRate_hz = 100.0;

// 40 s along a ring of 300 m at 15 m/s, that is twice over its first station; the lane changes at 10 s.
DriveReading RingDrive() {
  DriveReading reading;
  Drive& drive = reading.drive;
  drive.rate_hz = kRate_hz;
  const auto column = [](const auto& f) { return Sampled(40.0, kRate_hz, f); };
  drive.x_m = column([](double t) { return 15.0 * t; });
  const std::vector<double> missing(drive.size(), kMissing);
  for (auto* values : {&drive.heading_error_rad, &drive.yaw_radps, &drive.lane_width_m, &drive.lane_curvature_1pm})
    *values = missing;
  for (Neighbour* n : {&drive.leader, &drive.follower}) n->id = n->gap_m = n->speed_mps = n->length_m = missing;
  drive.speed_mps = column([](double) { return 15.0; });
  drive.s_m = column([](double t) { return std::fmod(15.0 * t, 300.0); });
  drive.lane = column([](double t) { return t < 10.0 ? -1.0 : -2.0; });
  drive.junction = column([](double t) { return std::fmod(t, 20.0) < 2.5 ? 1.0 : 0.0; });
  drive.lane_position_m = missing;
  return reading;
}

std::vector<Interval> Found(const char* text, const DriveReading& reading) {
  const auto spec = ParseInterval(text);
  EXPECT_TRUE(spec.ok()) << text << (spec.ok() ? "" : spec.error().Text());
  return FindIntervals(spec.value(), reading);
}

// The times at which 15 t is the station, in both laps.
TEST(Condition, EachTimeOnARangeOfStationsIsAnInterval) {
  const auto curve = Found("curve=while s_m >= 60 and s_m < 150", RingDrive());
  ASSERT_EQ(curve.size(), 2u);
  EXPECT_EQ(curve[0].name, "curve");
  EXPECT_EQ(curve[0].from_s, 4.0);
  EXPECT_EQ(curve[0].to_s, 10.0);
  EXPECT_EQ(curve[1].name, "curve#2");
  EXPECT_EQ(curve[1].from_s, 24.0);
  EXPECT_EQ(curve[1].to_s, 30.0);
  EXPECT_EQ(curve[1].reason, "");
}

TEST(Condition, LaneAndJunction) {
  const DriveReading ring = RingDrive();
  const auto lane = Found("l=while lane==-2", ring);
  ASSERT_EQ(lane.size(), 1u);
  EXPECT_EQ(lane[0].from_s, 10.0);
  EXPECT_EQ(lane[0].to_s, 40.0);
  const auto junction = Found("j=while junction != 0", ring);
  ASSERT_EQ(junction.size(), 2u);
  EXPECT_EQ(junction[1].from_s, 20.0);
  EXPECT_EQ(junction[1].to_s, 22.5);
  EXPECT_EQ(Found("t=while time_s > 39.985", ring).at(0).from_s, 39.99) << "of samples, not of the threshold";
}

// Half-open: a condition and its contrary have every sample once.
TEST(Condition, NeighboursAddUp) {
  const DriveReading ring = RingDrive();
  std::vector<int> seen(ring.drive.size(), 0);
  for (const char* text : {"a=while s_m < 123.4", "b=while s_m >= 123.4"}) {
    for (const Interval& interval : Found(text, ring)) {
      const auto [from, to] = SamplesOf(interval, kRate_hz, seen.size());
      for (std::size_t k = from; k < to; ++k) ++seen[k];
    }
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(seen.size()));
}

TEST(Condition, AGapInTheRecordingEndsAnInterval) {
  DriveReading ring = RingDrive();
  for (std::size_t k = 1200; k < 1250; ++k) ring.drive.x_m[k] = ring.drive.speed_mps[k] = kMissing;
  const auto fast = Found("fast=while speed_mps > 10", ring);
  ASSERT_EQ(fast.size(), 2u);
  EXPECT_EQ(fast[0].to_s, 12.0);
  EXPECT_EQ(fast[1].from_s, 12.5);
  EXPECT_EQ(Found("t=while time_s >= 0", ring).size(), 2u) << "a column that is not missing there";
}

// A missing value fulfils no relation, not even "is not equal".
TEST(Condition, MissingValuesFulfilNothing) {
  for (const char* text : {"a=while lane_position_m != 3", "a=while lane_position_m > -1e9", "a=while ttc_s < 1e9"}) {
    const auto none = Found(text, RingDrive());
    ASSERT_EQ(none.size(), 1u) << text;
    EXPECT_NE(none[0].reason.find("never holds from 0 s to 40 s"), std::string::npos) << none[0].reason;
    EXPECT_FALSE(none[0].unknown);
  }
}

TEST(Condition, ShortTimesAreLeftOutAndTimesLimitIt) {
  auto spec = ParseInterval("curve=while s_m >= 60 and s_m < 150").value();
  spec.from = ParseTimePoint("28").value();
  spec.min_s = 2.0;
  const auto within = FindIntervals(spec, RingDrive());
  ASSERT_EQ(within.size(), 1u);
  EXPECT_EQ(within[0].from_s, 28.0);
  EXPECT_EQ(within[0].to_s, 30.0);
  spec.min_s = 2.01;
  EXPECT_NE(FindIntervals(spec, RingDrive()).at(0).reason.find("never holds for 2.01 s"), std::string::npos);
}

// The ring as road 0 to station 100, 1 to 120 and 2 to 300, each with stations of its own: together the road 'ring'.
DriveReading RingInParts() {
  DriveReading ring = RingDrive();
  constexpr std::array kBegin_m{0.0, 100.0, 120.0};
  ring.drive.road.resize(ring.drive.size());
  for (std::size_t k = 0; k < ring.drive.size(); ++k) {
    double& s = ring.drive.s_m[k];
    const std::size_t part = s >= kBegin_m[2] ? 2 : s >= kBegin_m[1] ? 1 : 0;
    ring.drive.road[k] = static_cast<double>(part);
    s -= kBegin_m.at(part);
  }
  ring.roads = {{"ring", {{0.0, 0.0}, {1.0, 100.0}, {2.0, 120.0}}}, {"ring/1", {{0.0, 0.0}}}, {"ring/2", {{2.0, 0.0}}}};
  return ring;
}

// Stations count from the beginning of the road that is named: the whole one, or a part.
TEST(Condition, ARoadHasItsNameOrItsIndex) {
  const DriveReading ring = RingInParts();
  for (const char* text :
       {"a=while road == 'ring' and s_m >= 60 and s_m < 150", "a=while road==ring and s_m>=60 and s_m<150",
        "a=while s_m >= 60 and s_m < 150 and road == 'ring'"}) {
    const auto whole = Found(text, ring);
    ASSERT_EQ(whole.size(), 2u) << text;
    EXPECT_EQ(whole[1].from_s, 24.0);
    EXPECT_EQ(whole[1].to_s, 30.0);
  }
  for (const char* text : {"a=while road == 'ring/2' and s_m >= 30", "a=while road == 2 and s_m >= 30"}) {
    const auto part = Found(text, ring);
    ASSERT_EQ(part.size(), 2u) << text;
    EXPECT_EQ(part[0].from_s, 10.0);
    EXPECT_EQ(part[0].to_s, 20.0);
  }
  const auto other = Found("a=while road != 'ring/2'", ring);
  ASSERT_EQ(other.size(), 2u);
  EXPECT_EQ(other[0].to_s, 8.0);
}

TEST(Condition, ARoadThatTheWorldDoesNotHaveIsUnknown) {
  const auto none = Found("a=while road == 'rinf'", RingInParts());
  ASSERT_EQ(none.size(), 1u);
  EXPECT_TRUE(none[0].unknown);
  EXPECT_NE(none[0].reason.find("'ring'"), std::string::npos) << none[0].reason;
  const auto plane = Found("a=while road == 'ring'", RingDrive());
  EXPECT_TRUE(plane.at(0).unknown);
}

TEST(Condition, WrongConditionsAreRefusedWithTheNearestName) {
  const std::pair<const char*, const char*> wrong[]{{"sped_mps > 20", "did you mean 'speed_mps'?"},
                                                    {"speed_mps", "is no comparison"},
                                                    {"> 20", "is no comparison"},
                                                    {"", "is no comparison"},
                                                    {"speed_mps > 20 and ", "'20 and' is no number"},
                                                    {"speed_mps = 20", "'=' compares nothing"},
                                                    {"speed_mps => 20", "'=>' compares nothing"},
                                                    {"speed_mps > fast", "'fast' is no number"},
                                                    {"road > valley", "'valley' is no number"},
                                                    {"road == ''", "is no number"},
                                                    {"lane == 'valley'", "is no number"},
                                                    {"speed_mps > nan", "'nan' is no number"},
                                                    {"speed_mps > 20 or lane == 1", "is no number"},
                                                    {"speed_mps > 1 and lne == 1", "did you mean 'lane'?"}};
  for (const auto& [text, sentence] : wrong) {
    const auto condition = ParseCondition(text);
    ASSERT_FALSE(condition.ok()) << text;
    EXPECT_EQ(condition.error().exit_status(), 2);
    EXPECT_NE(condition.error().message.find(sentence), std::string::npos) << condition.error().message;
  }
}

}  // namespace
}  // namespace rodeira::measures
