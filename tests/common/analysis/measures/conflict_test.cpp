// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/conflict.hpp"

#include <gtest/gtest.h>

#include "common/analysis/measures/catalogue.hpp"
#include "common/analysis/measures/gap.hpp"
#include "tests/common/analysis/measures/signals.hpp"

namespace rodeira::measures {
namespace {

constexpr double kRate = 100.0;

// An approach at a constant closing speed of 8 m/s from 60 m, stopped at a TTC of 0.5 s: TTC = gap / 8, DRAC =
// dv / (2 TTC), TET = tau - 0.5, TIT = (tau - 0.5)^2 / 2.
TEST(Conflict, AnApproachAtConstantSpeed) {
  const auto gap = Sampled(7.0, kRate, [](double t) { return 60.0 - 8.0 * t; });
  const std::vector<double> own(gap.size(), 20.0), leader(gap.size(), 12.0);
  const auto ttc = TtcSeries(gap, own, leader), drac = DracSeries(gap, own, leader);
  for (std::size_t i = 0; i < gap.size(); ++i) {
    EXPECT_NEAR(ttc[i], 7.5 - static_cast<double>(i) / kRate, 1e-12);
    EXPECT_NEAR(drac[i], 8.0 / (2.0 * ttc[i]), 1e-12);
  }
  EXPECT_NEAR(*TimeExposedTtc(ttc, gap, kRate, 3.0).value, 2.5, 0.011);
  EXPECT_NEAR(*TimeIntegratedTtc(ttc, gap, kRate, 3.0).value, 2.5 * 2.5 / 2.0, 0.02);
  EXPECT_NEAR(*LeastTtc(ttc, gap).value, 0.51, 1e-9);
  // Mean of 1/TTC: the integral of 1/(7.5 - t) over 7 s is ln(7.5 / 0.5).
  EXPECT_NEAR(*MeanInverseTtc(ttc, gap).value, std::log(15.0) / 7.0, 0.003);
}

// gap - dv t - da t^2 / 2 = 0 by hand: 10 - 2 t - t^2 = 0 at t = sqrt 11 - 1.
TEST(Conflict, WithAccelerations) {
  EXPECT_NEAR(TimeToCollision_s(10.0, 12.0, 10.0, 2.0, 0.0), std::sqrt(11.0) - 1.0, 1e-12);
  EXPECT_NEAR(TimeToCollision_s(10.0, 12.0, 10.0, 0.0, 0.0), 5.0, 1e-12);
  // The leader brakes: closing although it is faster now. 10 + 2 t - 2 t^2 = 0 at (1 + sqrt 21) / 2.
  EXPECT_NEAR(TimeToCollision_s(10.0, 10.0, 12.0, 0.0, -4.0), (1.0 + std::sqrt(21.0)) / 2.0, 1e-12);
  EXPECT_TRUE(std::isnan(TimeToCollision_s(10.0, 12.0, 10.0, -2.0, 0.0))) << "it brakes in time";
  EXPECT_TRUE(std::isnan(TimeToCollision_s(10.0, 10.0, 10.0)));
  EXPECT_EQ(TimeToCollision_s(-0.2, 12.0, 10.0), 0.0);
}

// Braking behind a leader from the same speed v: it and the leader come to rest with the gap between them if it brakes
// as the leader does after v rho: gap - v rho = 0 at the reaction time gap / v.
TEST(Conflict, ABrakingLeader) {
  // v = 20, b = 4: the leader's way is 50 m. With 14 m of gap 400 / (2 * 64).
  EXPECT_NEAR(BrakingLeaderDrac_mps2(14.0, 20.0, 20.0, 4.0), 3.125, 1e-12);
  EXPECT_NEAR(BrakingLeaderDrac_mps2(0.0, 20.0, 20.0, 4.0), 4.0, 1e-12);
  EXPECT_NEAR(ModifiedDrac_mps2(3.0, 8.0), 2.0, 1e-12);
  EXPECT_TRUE(std::isnan(ModifiedDrac_mps2(1.0, 8.0)));
  EXPECT_TRUE(std::isnan(Drac_mps2(0.0, 20.0, 12.0)));
}

// The leader brakes by b from v, the follower by as much after rho: the least gap is gap - v rho, where both are at
// rest, and they collide where v rho is above the gap.
TEST(Conflict, AFollowerThatBrakesLaterKeepsTheGapLessItsWay) {
  constexpr double kSpeed = 20.0, kBraking = 4.0;
  const auto speed_at = [](double t) { return std::max(0.0, kSpeed - kBraking * std::max(0.0, t)); };
  const auto way_at = [](double t) {
    const double braked = std::clamp(t, 0.0, kSpeed / kBraking);
    return kSpeed * std::min(t, 0.0) + (kSpeed - 0.5 * kBraking * braked) * braked;
  };
  for (const double gap_m : {30.0, 24.0, 18.0}) {
    for (const double rho_s : {0.5, 0.9, 1.2}) {
      Drive drive;
      const auto own = Sampled(8.0, kRate, [&](double t) { return speed_at(t - rho_s); });
      GrowColumns(drive, own.size());
      drive.speed_mps = own;
      drive.leader.id.assign(own.size(), 1.0);
      drive.leader.speed_mps = Sampled(8.0, kRate, speed_at);
      drive.leader.gap_m = Sampled(8.0, kRate, [&](double t) {
        return gap_m + way_at(t) - (kSpeed * std::min(t, rho_s) + way_at(std::max(0.0, t - rho_s)));
      });
      const auto value = [&](const char* name) {
        const MeasureInfo& info = *FindMeasure(name).value();
        return info.compute({drive, 0, drive.size(), {}}, OptionValues(info.options, {})).value;
      };
      EXPECT_NEAR(*value("gap_min_m"), gap_m - kSpeed * rho_s, 1e-9) << gap_m << " " << rho_s;
      if (gap_m != kSpeed * rho_s) {
        EXPECT_EQ(*value("ttc_accelerated_min_s") == 0.0, gap_m < kSpeed * rho_s) << gap_m << " " << rho_s;
      }
    }
  }
}

// By hand, as measures of a drive: 8 m/s faster from 60 m, 7 s long. MDRAC = 8 / (2 (TTC - 1)), while TTC > 1 s; v^2 /
// (2 (gap + v_l^2 / 12)) grows with the gap's fall; with the same acceleration of both, TTC is gap / 8.
TEST(Conflict, MeasuresOfAnApproach) {
  Drive drive;
  const auto gap = Sampled(7.0, kRate, [](double t) { return 60.0 - 8.0 * t; });
  GrowColumns(drive, gap.size());
  drive.leader.gap_m = gap;
  drive.leader.id.assign(gap.size(), 7.0);
  drive.speed_mps = Sampled(7.0, kRate, [](double t) { return 20.0 - 0.5 * t; });
  drive.leader.speed_mps = Sampled(7.0, kRate, [](double t) { return 12.0 - 0.5 * t; });
  const auto value = [&](const char* name, const std::map<std::string, double>& given = {}) {
    const MeasureInfo& info = *FindMeasure(name).value();
    return *info.compute({drive, 0, drive.size(), {}}, OptionValues(info.options, given)).value;
  };
  EXPECT_NEAR(value("drac_modified_max_mps2", {{"reaction_s", 0.4}}), 8.0 / (2.0 * (0.51 - 0.4)), 1e-6);
  EXPECT_NEAR(value("drac_modified_max_mps2"), 8.0 / (2.0 * 0.01), 1e-6) << "TTC of 1.01 s";
  double largest = 0.0;
  for (std::size_t i = 0; i < gap.size(); ++i)
    largest = std::max(largest, BrakingLeaderDrac_mps2(gap[i], drive.speed_mps[i], drive.leader.speed_mps[i], 6.0));
  EXPECT_EQ(value("drac_braking_leader_max_mps2"), largest);
  EXPECT_NEAR(value("ttc_accelerated_min_s"), 0.51, 1e-6);
}

TEST(Conflict, WithoutALeaderAllIsMissing) {
  const std::vector<double> none(50, kMissing), own(50, 20.0);
  const auto ttc = TtcSeries(none, own, none);
  for (const Measure& m : {TimeExposedTtc(ttc, none, kRate, 3.0), TimeIntegratedTtc(ttc, none, kRate, 3.0),
                           LeastTtc(ttc, none), MeanInverseTtc(ttc, none)}) {
    EXPECT_FALSE(m.value);
    EXPECT_EQ(m.reason, "no leader");
  }
  // With a leader that draws away the exposure is 0, and there is no least TTC.
  const std::vector<double> gap(50, 30.0), faster(50, 25.0);
  const auto away = TtcSeries(gap, own, faster);
  EXPECT_EQ(*TimeExposedTtc(away, gap, kRate, 3.0).value, 0.0);
  EXPECT_EQ(*MeanInverseTtc(away, gap).value, 0.0);
  EXPECT_EQ(LeastTtc(away, gap).reason, "the vehicle never closes in");
}

// A leader beyond 150 m, or beyond 6 s and 20 m, is none; a standing vehicle has a gap and no time gap.
TEST(Conflict, LeadersBeyondTheLimitsAreNone) {
  const std::vector<double> gap{20.0, 160.0, 130.0, 5.0, kMissing}, own{10.0, 40.0, 20.0, 0.0, 10.0};
  const auto followed = FollowedGap(gap, own, {});
  EXPECT_EQ(followed[0], 20.0);
  EXPECT_TRUE(std::isnan(followed[1])) << "160 m";
  EXPECT_TRUE(std::isnan(followed[2])) << "6.5 s";
  EXPECT_EQ(followed[3], 5.0);
  const auto time = TimeGap(followed, own, {});
  EXPECT_EQ(time[0], 2.0);
  EXPECT_TRUE(std::isnan(time[3]));
  EXPECT_EQ(*LeaderShare(followed, {}).value, 0.4);
  EXPECT_EQ(Headway(gap, std::vector<double>(5, 4.5))[0], 24.5);
}

// A queue that creeps: 8 m behind a leader, from 0 to 3 m/s. The leader counts at every speed; the time gap only where
// it is at most 6 s, from 4/3 m/s on.
TEST(Conflict, AQueueThatCreepsKeepsItsLeader) {
  const auto own = Sampled(3.0, kRate, [](double t) { return t; });
  const std::vector<double> gap(own.size(), 8.0);
  const auto followed = FollowedGap(gap, own, {});
  EXPECT_EQ(*LeaderShare(followed, {}).value, 1.0);
  const auto time = TimeGap(followed, own, {});
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (own[i] * 6.0 < 8.0)
      EXPECT_TRUE(std::isnan(time[i])) << own[i];
    else
      EXPECT_EQ(time[i], 8.0 / own[i]);
  }
}

// The limit is continuous in the speed: 20 m up to 10/3 m/s, 6 s, and 150 m from 25 m/s on; in reverse 20 m, and 150 m
// where the speed is not known.
TEST(Conflict, TheLimitOfALeaderGrowsWithTheSpeed) {
  const auto counts = [](double gap_m, double own_mps) {
    return !std::isnan(FollowedGap(std::vector{gap_m}, std::vector{own_mps}, {})[0]);
  };
  const double limits[][2] = {{0.0, 20.0},  {0.05, 20.0},  {0.2, 20.0},   {3.3, 20.0},  {5.0, 30.0},
                              {10.0, 60.0}, {25.0, 150.0}, {40.0, 150.0}, {-2.0, 20.0}, {kMissing, 150.0}};
  for (const auto& [own_mps, limit_m] : limits) {
    EXPECT_TRUE(counts(limit_m - 1e-6, own_mps)) << own_mps;
    EXPECT_FALSE(counts(limit_m + 1e-6, own_mps)) << own_mps;
  }
}

// Behind a leader beyond the limits the share is 0, and the missing values name the nearest one.
TEST(Conflict, ALeaderBeyondTheLimitsIsNamed) {
  Drive drive;
  GrowColumns(drive, 4);
  drive.speed_mps = {2.0, 2.0, 2.0, 2.0};
  drive.road = {0.0, 0.0, 0.0, 0.0};
  drive.leader.gap_m = {44.0, 41.5, 47.0, kMissing};
  drive.leader.speed_mps = {1.0, 1.0, 1.0, kMissing};
  const auto measured = [&](const char* name, const std::map<std::string, double>& given) {
    const MeasureInfo& info = *FindMeasure(name).value();
    return info.compute({drive, 0, 4, {}}, OptionValues(info.options, given));
  };
  EXPECT_EQ(measured("leader_share", {}).value, 0.0);
  for (const char* name : {"gap_mean_m", "gap_min_m", "time_gap_min_s", "headway_mean_m", "ttc_min_s", "tet_s"}) {
    EXPECT_FALSE(measured(name, {}).value) << name;
    EXPECT_EQ(measured(name, {}).reason, "no leader within the limits; the nearest is 41.5 m ahead") << name;
  }
  const std::map<std::string, double> far{{"max_time_gap_s", 22.0}};
  EXPECT_EQ(measured("leader_share", far).value, 0.5) << "22 and 20.75 s";
  EXPECT_EQ(measured("gap_min_m", far).value, 41.5);
  EXPECT_EQ(measured("ttc_min_s", far).value, 41.5);
  EXPECT_EQ(measured("time_gap_min_s", far).value, 20.75);
  drive.leader.gap_m.assign(4, kMissing);
  EXPECT_EQ(measured("gap_min_m", far).reason, "no leader");
}

}  // namespace
}  // namespace rodeira::measures
