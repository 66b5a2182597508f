// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "common/analysis/measures/acceleration.hpp"
#include "common/analysis/measures/catalogue.hpp"
#include "common/analysis/measures/fuel.hpp"
#include "common/analysis/measures/speed.hpp"
#include "common/analysis/measures/statistics.hpp"
#include "common/analysis/measures/stops.hpp"

namespace rodeira::measures {
namespace {

const OptionInfo kMinSpeed{"min_speed_mps", 0.1, 0, 50, "slower samples are left out as waits"};

std::vector<double> MovingIn(const DriveCut& cut, const OptionValues& o) {
  return InMotion(cut(cut.drive.speed_mps), o["min_speed_mps"]);
}

Measure WithMinSpeed(Measure measure, const OptionValues& o) {
  measure.options.push_back(Used({{"min_speed_mps", o["min_speed_mps"]}}).front());
  return measure;
}

template <int Percent>
Measure SpeedPercentile(const DriveCut& cut, const OptionValues& o) {
  return WithMinSpeed(QuantileOf(MovingIn(cut, o), "m/s", Percent / 100.0), o);
}

AccelerationOptions AccelerationOf(const OptionValues& o) { return {o["cutoff_hz"], o["window_s"]}; }

const std::vector<OptionInfo> kAccelerationOptions{
    {"cutoff_hz", 5, 0.1, 50, "low-pass of the speed (Butterworth order 2, both ways)"},
    {"window_s", 1, 0.01, 60, "of means and slopes"}};
constexpr const char* kAccelerationTraps =
    "gear changes are jerks of the car and not of the foot; state the filter, which reflects 0.09 s at each end";

template <Measure (*Function)(Series, double, const AccelerationOptions&)>
Measure AccelerationIn(const DriveCut& cut, const OptionValues& o) {
  return Function(cut(cut.drive.speed_mps), cut.drive.rate_hz, AccelerationOf(o));
}

// Up to the end of the interval, where the next one begins: the distances of neighbours add up.
Measure DistanceIn(const DriveCut& cut, const OptionValues&) {
  const std::vector<double>& speed_mps = cut.drive.speed_mps;
  Measure distance = Distance(cut(speed_mps), cut.drive.rate_hz);
  if (!distance.value || cut.to >= speed_mps.size()) return distance;
  const double last_m = 0.5 * (speed_mps[cut.to - 1] + speed_mps[cut.to]) / cut.drive.rate_hz;
  if (!std::isnan(last_m)) *distance.value += last_m;
  return distance;
}

const OptionInfo kDensity{"density_kgpl", 0.745, 0.1, 2, "of the fuel; petrol 0.745, diesel 0.832"};

// Of the first stop after a motion: where a drive begins is no stop.
Measure StopLineDistance(const DriveCut& cut, const OptionValues&) {
  const StopOptions options;
  const auto moves = std::ranges::find_if(cut(cut.drive.speed_mps), [&](double v) { return v > options.moving_mps; });
  const auto from = static_cast<std::size_t>(moves - cut(cut.drive.speed_mps).begin());
  const Series light = cut(cut.drive.light_ahead_m), junction = cut(cut.drive.junction_ahead_m);
  std::vector<double> ahead(light.size());
  for (std::size_t i = 0; i < ahead.size(); ++i) ahead[i] = std::fmin(light[i], junction[i]);
  return StopDistance(cut(cut.drive.speed_mps).subspan(from), Series(ahead).subspan(from), options);
}

// With the sample at which the next interval begins: what is counted from sample to sample adds up.
Series WithNext(const DriveCut& cut, const std::vector<double>& column) {
  return Part(column, cut.from, std::min(cut.to + 1, column.size()));
}

}  // namespace

std::vector<MeasureInfo> SpeedMeasures() {
  const char* family = "speed";
  const char* waits = "waits at lights dominate a mean with them";
  return {
      {"speed_mean_mps",
       family,
       "mean speed over time",
       "mean of v",
       waits,
       "SAE J2944",
       {kMinSpeed},
       [](const DriveCut& cut, const OptionValues& o) {
         return MeanSpeed(cut(cut.drive.speed_mps), o["min_speed_mps"]);
       }},
      {"speed_mean_by_distance_mps",
       family,
       "mean speed over distance",
       "sum v^2 / sum v",
       "larger than the mean over time",
       "SAE J2944",
       {kMinSpeed},
       [](const DriveCut& cut, const OptionValues& o) {
         return MeanSpeedByDistance(cut(cut.drive.speed_mps), o["min_speed_mps"]);
       }},
      {"speed_sd_mps",
       family,
       "standard deviation of speed",
       "SD of v",
       "grows with the number of speed limits in it",
       "SAE J2944",
       {kMinSpeed, {"ddof", 1, 0, 1, "0: divided by n, 1: by n - 1"}},
       [](const DriveCut& cut, const OptionValues& o) {
         const auto by = o["ddof"] == 0.0 ? Denominator::kN : Denominator::kNMinus1;
         return WithMinSpeed(DeviationOf(MovingIn(cut, o), "m/s", by), o);
       }},
      {"speed_p15_mps",
       family,
       "15th percentile of speed",
       "percentile of type 7",
       waits,
       "SAE J2944",
       {kMinSpeed},
       SpeedPercentile<15>},
      {"speed_p50_mps",
       family,
       "median of speed",
       "percentile of type 7",
       waits,
       "SAE J2944",
       {kMinSpeed},
       SpeedPercentile<50>},
      {"speed_p85_mps",
       family,
       "85th percentile of speed",
       "percentile of type 7",
       waits,
       "SAE J2944",
       {kMinSpeed},
       SpeedPercentile<85>},
      {"speed_max_mps",
       family,
       "largest speed",
       "max of v",
       "one sample decides",
       "SAE J2944",
       {},
       [](const DriveCut& cut, const OptionValues&) { return MaximumOf(cut(cut.drive.speed_mps), "m/s"); }},
      {"above_limit_share",
       family,
       "share of time above the speed limit",
       "share of v > limit + over",
       "of the time with a limit; missing where the world says none",
       "SAE J2944",
       {{"over_mps", 0, 0, 50, "so much above the limit"}},
       [](const DriveCut& cut, const OptionValues& o) {
         return ShareAboveLimit(cut(cut.drive.speed_mps), cut(cut.drive.speed_limit_mps), o["over_mps"]);
       }},
      {"distance_m",
       family,
       "way that was driven",
       "integral of v",
       "negative in reverse",
       "SAE J2944",
       {},
       DistanceIn},
      {"stops_n",
       family,
       "number of stops",
       "from v < 0.1 m/s to v > 0.5 m/s",
       "hysteresis makes one of a rocking stop",
       "SAE J2944",
       {},
       [](const DriveCut& cut, const OptionValues&) { return StopCount(cut(cut.drive.speed_mps), {}); }},
      {"stop_time_s",
       family,
       "time in stops",
       "sum of their durations",
       "the creep before a stop is not in it",
       "SAE J2944",
       {},
       [](const DriveCut& cut, const OptionValues&) {
         return StopTime(cut(cut.drive.speed_mps), cut.drive.rate_hz, {});
       }},
      {"stop_line_distance_m",
       family,
       "distance from the front to the line at the first stop",
       "light_ahead_m, or junction_ahead_m where that is nearer, at the first v < 0.1 m/s",
       "the line is the light's, or the begin of the junction; negative beyond it; missing in a junction",
       "SAE J2944",
       {},
       StopLineDistance},
      {"deceleration_max_mps2", family, "largest deceleration", "max of -dv/dt of the low-passed speed",
       kAccelerationTraps, "SAE J2944", kAccelerationOptions, AccelerationIn<LargestDeceleration>},
      {"deceleration_window_max_mps2", family, "largest mean deceleration over a window",
       "max of (v(t) - v(t + w)) / w", kAccelerationTraps, "SAE J2944", kAccelerationOptions,
       AccelerationIn<LargestMeanDeceleration>},
      {"jerk_negative_max_mps3", family, "largest negative jerk over a window", "max of (a(t) - a(t + w)) / w",
       kAccelerationTraps, "ISO 15622", kAccelerationOptions, AccelerationIn<LargestNegativeJerk>},
      {"jerk_rms_mps3", family, "root mean square of jerk", "sqrt(mean(j^2)), j = d2v/dt2 of the low-passed speed",
       kAccelerationTraps, "Green et al. 2024", kAccelerationOptions, AccelerationIn<RmsJerk>},
      {"discomfort_share",
       family,
       "share of time with an uncomfortable acceleration",
       "share of sqrt((dv/dt)^2 + (v r)^2) > threshold, r the yaw rate",
       "a standing passenger bears less than a seated one",
       "Hoberock 1977",
       {{"cutoff_hz", 5, 0.1, 50, "low-pass of the speed (Butterworth order 2, both ways)"},
        {"threshold_mps2", 1.5, 0.01, 50, "acceleration in the plane"}},
       [](const DriveCut& cut, const OptionValues& o) {
         return DiscomfortShare(cut(cut.drive.speed_mps), cut(cut.drive.yaw_radps), cut.drive.rate_hz,
                                {o["cutoff_hz"], o["threshold_mps2"]});
       }},
      {"fuel_l",
       family,
       "fuel that was burnt",
       "increase of the fuel used since the start / density",
       "agents of the traffic have none",
       "UN R101",
       {kDensity},
       [](const DriveCut& cut, const OptionValues& o) {
         return FuelUsed(WithNext(cut, cut.drive.fuel_used_kg), {o["density_kgpl"]});
       }},
      {"fuel_lp100km",
       family,
       "fuel over the way",
       "litres / way * 100 km",
       "waits raise it; missing where the way is shorter than 1 m",
       "UN R101",
       {kDensity},
       [](const DriveCut& cut, const OptionValues& o) {
         return FuelOverDistance(WithNext(cut, cut.drive.fuel_used_kg), WithNext(cut, cut.drive.speed_mps),
                                 cut.drive.rate_hz, {o["density_kgpl"]});
       }},
  };
}

}  // namespace rodeira::measures
