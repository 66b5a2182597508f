// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "common/analysis/measures/acceleration.hpp"
#include "common/analysis/measures/catalogue.hpp"
#include "common/analysis/measures/conflict.hpp"
#include "common/analysis/measures/following.hpp"
#include "common/analysis/measures/gap.hpp"
#include "common/analysis/measures/statistics.hpp"

namespace rodeira::measures {
namespace {

const std::vector<OptionInfo> kFollowedOptions{{"max_gap_m", 150, 1, 250, "a leader farther ahead is none"},
                                               {"max_time_gap_s", 6, 0.1, 60, "the same in time"},
                                               {"near_gap_m", 20, 0, 250, "a nearer leader counts at any speed"},
                                               {"min_speed_mps", 0.1, 0, 50, "below, a time gap is missing"}};

FollowedOptions FollowedOf(const OptionValues& o) {
  return {o["max_gap_m"], o["max_time_gap_s"], o["near_gap_m"], o["min_speed_mps"]};
}

std::vector<double> GapIn(const DriveCut& cut, const OptionValues& o) {
  return FollowedGap(cut(cut.drive.leader.gap_m), cut(cut.drive.speed_mps), FollowedOf(o));
}

// Without a leader within the limits all of these are missing for the same reason.
Measure OfLeader(Measure measure, const DriveCut& cut, const OptionValues& o) {
  if (!measure.value && CountValid(GapIn(cut, o)) == 0) {
    const auto nearest_m = Minimum(cut(cut.drive.leader.gap_m));
    measure.reason = nearest_m ? fmt::format("no leader within the limits; the nearest is {:.1f} m ahead", *nearest_m)
                               : std::string("no leader");
  }
  const UsedOptions used = UsedOf(FollowedOf(o));
  measure.options.insert(measure.options.end(), used.begin(), used.end());
  return measure;
}

std::vector<double> TimeGapIn(const DriveCut& cut, const OptionValues& o) {
  return TimeGap(GapIn(cut, o), cut(cut.drive.speed_mps), FollowedOf(o));
}

Measure OfTimeGap(Measure measure, const DriveCut& cut, const OptionValues& o) {
  if (!measure.value) measure.reason = "behind a leader, no time gap is within the limits";
  return OfLeader(std::move(measure), cut, o);
}

std::vector<double> TtcIn(const DriveCut& cut, Series gap) {
  return TtcSeries(gap, cut(cut.drive.speed_mps), cut(cut.drive.leader.speed_mps));
}

const OptionInfo kThreshold{"threshold_s", 3, 0.1, 20, "of the time to collision"};
std::vector<OptionInfo> With(const OptionInfo& option) {
  std::vector<OptionInfo> options = kFollowedOptions;
  options.push_back(option);
  return options;
}

// The speed of one leader; missing where another one follows it.
std::vector<double> LeaderSpeedIn(const DriveCut& cut) {
  const Series id = cut(cut.drive.leader.id), speed = cut(cut.drive.leader.speed_mps);
  std::vector<double> leader(speed.begin(), speed.end());
  for (std::size_t i = 1; i < leader.size(); ++i) {
    if (id[i] != id[i - 1]) leader[i] = kMissing;
  }
  return leader;
}

// The time to collision if both keep their accelerations.
Measure AcceleratedTtc(const DriveCut& cut, const OptionValues& o) {
  const AccelerationOptions filter{.cutoff_hz = o["cutoff_hz"]};
  const auto gap = GapIn(cut, o), leader = LeaderSpeedIn(cut);
  const Series own = cut(cut.drive.speed_mps);
  const auto own_mps2 = SmoothAcceleration(own, cut.drive.rate_hz, filter);
  const auto leader_mps2 = SmoothAcceleration(leader, cut.drive.rate_hz, filter);
  std::vector<double> ttc(gap.size());
  for (std::size_t i = 0; i < ttc.size(); ++i)
    ttc[i] = TimeToCollision_s(gap[i], own[i], leader[i], own_mps2[i], leader_mps2[i]);
  Measure measure = LeastTtc(ttc, gap);
  measure.options = Used({{"cutoff_hz", filter.cutoff_hz}, {"padding_s", kPadding_s}});
  return OfLeader(std::move(measure), cut, o);
}

// at(gap, own speed, leader's speed) of each sample: the largest.
template <class At>
Measure LargestDrac(const DriveCut& cut, const OptionValues& o, const char* option, const At& at) {
  const auto gap = GapIn(cut, o);
  const Series own = cut(cut.drive.speed_mps), leader = cut(cut.drive.leader.speed_mps);
  std::vector<double> drac(gap.size());
  for (std::size_t i = 0; i < drac.size(); ++i) drac[i] = at(gap[i], own[i], leader[i]);
  Measure measure = MaximumOf(drac, "m/s2");
  if (!measure.value) measure.reason = "the vehicle never closes in so far";
  measure.options.push_back(Used({{option, o[option]}}).front());
  return OfLeader(std::move(measure), cut, o);
}

// Both speeds where there is one leader.
Following FollowingIn(const DriveCut& cut, const OptionValues& o) {
  return FollowLeader(LeaderSpeedIn(cut), cut(cut.drive.speed_mps), cut.drive.rate_hz,
                      {.segment_s = o["segment_s"],
                       .frequency_hz = o["frequency_hz"],
                       .min_segments = static_cast<std::size_t>(o["min_segments"])});
}

const std::vector<OptionInfo> kFollowingOptions{
    {"segment_s", 60, 4, 600, "of Welch's estimate; Hann, half overlapped"},
    {"frequency_hz", 0, 0, 1, "at which the leader's speed varies; 0: where coherence is greatest below 0.1 Hz"},
    {"min_segments", 5, 2, 1000, "fewer make the value missing"}};
constexpr const char* kFollowingTraps = "one segment alone always has a coherence of 1; phase wraps at half a period";
constexpr const char* kBrookhuis = "Brookhuis et al. 1994";

}  // namespace

std::vector<MeasureInfo> LeaderMeasures() {
  const char* family = "leader";
  const char* cut_off = "missing without a leader within the limits, never 0; a new leader is a jump";
  return {
      {"leader_share", family, "share of time with a leader", "samples with a leader / all samples", cut_off,
       "SAE J2944 8.1.4", kFollowedOptions,
       [](const DriveCut& cut, const OptionValues& o) {
         // Where there is no road, whether there is a leader is not known.
         const Series road = cut(cut.drive.road);
         if (CountValid(road) == 0)
           return NotFound("no sample is on a road", "1", 0, road.size(), UsedOf(FollowedOf(o)));
         return LeaderShare(GapIn(cut, o), FollowedOf(o));
       }},
      {"gap_mean_m", family, "mean gap to the leader", "mean of (leader's rear - own front) along the lane", cut_off,
       "SAE J2944 8.1.4", kFollowedOptions,
       [](const DriveCut& cut, const OptionValues& o) { return OfLeader(MeanOf(GapIn(cut, o), "m"), cut, o); }},
      {"gap_min_m", family, "least gap to the leader", "min of the gap", cut_off, "SAE J2944 8.1.4", kFollowedOptions,
       [](const DriveCut& cut, const OptionValues& o) { return OfLeader(MinimumOf(GapIn(cut, o), "m"), cut, o); }},
      {"time_gap_mean_s", family, "mean time gap", "mean of gap / own speed", cut_off, "SAE J2944 8.1.4",
       kFollowedOptions,
       [](const DriveCut& cut, const OptionValues& o) { return OfTimeGap(MeanOf(TimeGapIn(cut, o), "s"), cut, o); }},
      {"time_gap_min_s", family, "least time gap", "min of gap / own speed", cut_off, "SAE J2944 8.1.4",
       kFollowedOptions,
       [](const DriveCut& cut, const OptionValues& o) { return OfTimeGap(MinimumOf(TimeGapIn(cut, o), "s"), cut, o); }},
      {"headway_mean_m", family, "mean headway", "mean of gap + leader's length", cut_off, "SAE J2944 8.1.4",
       kFollowedOptions,
       [](const DriveCut& cut, const OptionValues& o) {
         return OfLeader(MeanOf(Headway(GapIn(cut, o), cut(cut.drive.leader.length_m)), "m"), cut, o);
       }},
      {"ttc_min_s", family, "least time to collision", "min of gap / (v - v_leader) while closing in",
       "a mean of TTC has no meaning; missing where the vehicle never closes in", "Hayward 1972", kFollowedOptions,
       [](const DriveCut& cut, const OptionValues& o) {
         const auto gap = GapIn(cut, o);
         return OfLeader(LeastTtc(TtcIn(cut, gap), gap), cut, o);
       }},
      {"ttc_accelerated_min_s", family, "least time to collision if both keep their accelerations",
       "min of the first root of gap - dv t - da t^2 / 2", "accelerations of low-passed speeds; far roots mean little",
       "SAE J2944", With({"cutoff_hz", 5, 0.1, 50, "low-pass of both speeds (Butterworth order 2, both ways)"}),
       AcceleratedTtc},
      {"inverse_ttc_mean_1ps", family, "mean of 1/TTC", "mean of max(0, v - v_leader) / gap", cut_off, "Hayward 1972",
       kFollowedOptions,
       [](const DriveCut& cut, const OptionValues& o) {
         const auto gap = GapIn(cut, o);
         return OfLeader(MeanInverseTtc(TtcIn(cut, gap), gap), cut, o);
       }},
      {"tet_s", family, "time exposed: TTC below a threshold", "sum of dt where TTC < threshold", cut_off,
       "Minderhoud & Bovy 2001", With(kThreshold),
       [](const DriveCut& cut, const OptionValues& o) {
         const auto gap = GapIn(cut, o);
         return OfLeader(TimeExposedTtc(TtcIn(cut, gap), gap, cut.drive.rate_hz, o["threshold_s"]), cut, o);
       }},
      {"tit_s2", family, "time integrated: by how much, and how long",
       "integral of (threshold - TTC) where TTC < threshold", cut_off, "Minderhoud & Bovy 2001", With(kThreshold),
       [](const DriveCut& cut, const OptionValues& o) {
         const auto gap = GapIn(cut, o);
         return OfLeader(TimeIntegratedTtc(TtcIn(cut, gap), gap, cut.drive.rate_hz, o["threshold_s"]), cut, o);
       }},
      {"drac_max_mps2", family, "largest deceleration rate to avoid the crash", "max of (v - v_leader)^2 / (2 gap)",
       "missing where the vehicle never closes in", "Cooper & Ferguson 1976", kFollowedOptions,
       [](const DriveCut& cut, const OptionValues& o) {
         const auto drac = DracSeries(GapIn(cut, o), cut(cut.drive.speed_mps), cut(cut.drive.leader.speed_mps));
         return OfLeader(MaximumOf(drac, "m/s2"), cut, o);
       }},
      {"drac_modified_max_mps2", family, "largest deceleration rate to avoid the crash after a reaction time",
       "max of (v - v_leader) / (2 (TTC - reaction_s))", "missing where TTC is below the reaction time",
       "SUMO SSM Device", With({"reaction_s", 1, 0, 10, "before the vehicle brakes"}),
       [](const DriveCut& cut, const OptionValues& o) {
         return LargestDrac(cut, o, "reaction_s", [&](double gap, double own, double leader) {
           return ModifiedDrac_mps2(TimeToCollision_s(gap, own, leader), own - leader, o["reaction_s"]);
         });
       }},
      {"drac_braking_leader_max_mps2", family, "largest deceleration to stop behind a leader that brakes",
       "max of v^2 / (2 (gap + v_leader^2 / (2 leader_mps2)))", "also without closing in: another measure than DRAC",
       "equation of motion", With({"leader_mps2", 6, 0.1, 15, "braking of the leader"}),
       [](const DriveCut& cut, const OptionValues& o) {
         return LargestDrac(cut, o, "leader_mps2", [&](double gap, double own, double leader) {
           return BrakingLeaderDrac_mps2(gap, own, leader, o["leader_mps2"]);
         });
       }},
      {"following_coherence", family, "coherence of the leader's and the own speed", "|Sxy|^2 / (Sxx Syy)",
       kFollowingTraps, kBrookhuis, kFollowingOptions,
       [](const DriveCut& cut, const OptionValues& o) { return FollowingIn(cut, o).coherence; }},
      {"following_modulus", family, "own amplitude over the leader's", "|Sxy| / Sxx", kFollowingTraps, kBrookhuis,
       kFollowingOptions, [](const DriveCut& cut, const OptionValues& o) { return FollowingIn(cut, o).modulus; }},
      {"following_phase_rad", family, "phase of the own speed", "arg Sxy, negative where the own speed lags",
       kFollowingTraps, kBrookhuis, kFollowingOptions,
       [](const DriveCut& cut, const OptionValues& o) { return FollowingIn(cut, o).phase; }},
      {"following_delay_s", family, "delay of the own speed", "-arg Sxy / (2 pi f)", kFollowingTraps, kBrookhuis,
       kFollowingOptions, [](const DriveCut& cut, const OptionValues& o) { return FollowingIn(cut, o).delay; }},
  };
}

}  // namespace rodeira::measures
