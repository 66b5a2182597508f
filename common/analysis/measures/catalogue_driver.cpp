// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "common/analysis/measures/catalogue.hpp"
#include "common/analysis/measures/conflict.hpp"
#include "common/analysis/measures/pedals.hpp"
#include "common/analysis/measures/responses.hpp"
#include "common/analysis/measures/statistics.hpp"

namespace rodeira::measures {
namespace {

const std::vector<OptionInfo> kPedalOptions{{"on", 0.02, 0, 1, "pressed from above this share of its travel"},
                                            {"off", 0.01, 0, 1, "until below this one"}};
PedalOptions PedalOf(const OptionValues& o) { return {o["on"], o["off"]}; }

const std::vector<OptionInfo> kResponseOptions{
    {"release_share", 0.1, 0, 1, "the accelerator begins to be released below 1 - this, of its value at the event"},
    {"released", 0.01, 0, 1, "and is released below this travel"},
    {"brake_onset", 0.01, 0, 1, "of the brake's travel"},
    {"steering_deg", 2, 0, 360, "from the angle at the event"},
    {"steering_hold_s", 0.1, 0, 10, "held so long"},
    {"anticipation_s", 0.15, 0, 10, "an earlier response is flagged"}};
ResponseOptions ResponseOf(const OptionValues& o) {
  ResponseOptions options;
  options.release_share = o["release_share"];
  options.released = o["released"];
  options.brake_onset = o["brake_onset"];
  options.steering_deg = o["steering_deg"];
  options.steering_hold_s = o["steering_hold_s"];
  options.anticipation_s = o["anticipation_s"];
  return options;
}

Response FirstResponseIn(const DriveCut& cut, const ResponseOptions& options) {
  return FirstResponse(cut(cut.drive.throttle), cut(cut.drive.brake), cut(cut.drive.steering_wheel_deg),
                       cut.drive.rate_hz, options);
}

// What a column, or two, has at one sample of the cut.
using ValueAt = double (*)(const Drive& drive, std::size_t k);
double SpeedAt(const Drive& drive, std::size_t k) { return drive.speed_mps[k]; }
double GapAt(const Drive& drive, std::size_t k) { return drive.leader.gap_m[k]; }
double TtcAt(const Drive& drive, std::size_t k) {
  return TimeToCollision_s(drive.leader.gap_m[k], drive.speed_mps[k], drive.leader.speed_mps[k]);
}

Measure ValueOf(ValueAt at, const DriveCut& cut, std::size_t sample, const char* unit, UsedOptions used) {
  const std::size_t all = cut.to - cut.from;
  if (sample >= all) return NotFound("the interval has no sample", unit, 0, all, std::move(used));
  const double value = at(cut.drive, cut.from + sample);
  if (std::isnan(value))
    return NotFound(at == SpeedAt ? "the sample is missing" : "no leader, or none that is closed in on", unit, 0, all,
                    std::move(used));
  Measure measure = Found(value, unit, 1, all, std::move(used));
  measure.valid_share = 1.0;
  return measure;
}

template <ValueAt at>
Measure AtBegin(const DriveCut& cut, const char* unit) {
  return ValueOf(at, cut, 0, unit, Used({{"at", "begin"}}));
}

template <ValueAt at>
Measure AtResponse(const DriveCut& cut, const OptionValues& o, const char* unit) {
  const ResponseOptions options = ResponseOf(o);
  const Response response = FirstResponseIn(cut, options);
  Measure first = AsMeasure(response, cut(cut.drive.steering_wheel_deg), cut.drive.rate_hz, options);
  first.options.push_back({"at", "first response"});
  if (!response.time_s) return NotFound(first.reason, unit, 0, cut.to - cut.from, std::move(first.options));
  return ValueOf(at, cut, static_cast<std::size_t>(std::llround(*response.time_s * cut.drive.rate_hz)), unit,
                 std::move(first.options));
}

constexpr const char* kResponseTraps =
    "from the interval's begin; missing, with its flag, if already there (pre) or not before the end (censored)";
constexpr const char* kAtTraps = "one sample; an interval that begins at an event begins at its step";
constexpr const char* kGreen = "Green et al. 2024";

std::vector<OptionInfo> WithFullBrake() {
  std::vector<OptionInfo> options = kResponseOptions;
  options.push_back({"full_brake_share", 0.95, 0.01, 1, "of the largest travel in the interval"});
  return options;
}

}  // namespace

std::vector<MeasureInfo> DriverMeasures() {
  const char* family = "pedals and responses";
  return {
      {"throttle_mean",
       family,
       "mean of the accelerator's travel, 0 to 1",
       "mean",
       "a resting foot is in it",
       kGreen,
       {},
       [](const DriveCut& cut, const OptionValues&) { return MeanOf(cut(cut.drive.throttle), "1"); }},
      {"throttle_sd",
       family,
       "standard deviation of the accelerator's travel",
       "SD",
       "a resting foot is in it",
       kGreen,
       {{"ddof", 1, 0, 1, "0: divided by n, 1: by n - 1"}},
       [](const DriveCut& cut, const OptionValues& o) {
         return DeviationOf(cut(cut.drive.throttle), "1", o["ddof"] == 0.0 ? Denominator::kN : Denominator::kNMinus1);
       }},
      {"brake_presses_n", family, "number of presses of the brake", "from above `on` to below `off`",
       "a resting foot is no press", kGreen, kPedalOptions,
       [](const DriveCut& cut, const OptionValues& o) {
         return PedalPressCount(cut(cut.drive.brake), cut.drive.rate_hz, PedalOf(o));
       }},
      {"brake_first_s", family, "first press of the brake, after the interval's begin", "time of the first press",
       "0 where the brake is pressed at the begin", kGreen, kPedalOptions,
       [](const DriveCut& cut, const OptionValues& o) {
         return FirstPedalPress(cut(cut.drive.brake), cut.drive.rate_hz, PedalOf(o));
       }},
      {"brake_max",
       family,
       "largest travel of the brake, 0 to 1",
       "max",
       "one sample decides",
       kGreen,
       {},
       [](const DriveCut& cut, const OptionValues&) { return MaximumOf(cut(cut.drive.brake), "1"); }},
      {"brake_integral_s", family, "integral of the brake's travel over its presses", "sum of travel dt",
       "depends on the pedal's characteristic", kGreen, kPedalOptions,
       [](const DriveCut& cut, const OptionValues& o) {
         return PedalIntegral(cut(cut.drive.brake), cut.drive.rate_hz, PedalOf(o));
       }},
      {"both_pedals_share", family, "share of time with both pedals pressed", "share of samples",
       "a resting foot is no press", kGreen, kPedalOptions,
       [](const DriveCut& cut, const OptionValues& o) {
         return BothPedalsShare(cut(cut.drive.throttle), cut(cut.drive.brake), cut.drive.rate_hz, PedalOf(o));
       }},
      {"accelerator_release_s", family, "time to the begin of the accelerator's release",
       "first fall by release_share that ends released", kResponseTraps, kGreen, kResponseOptions,
       [](const DriveCut& cut, const OptionValues& o) {
         const Series throttle = cut(cut.drive.throttle);
         return AsMeasure(AcceleratorRelease(throttle, cut.drive.rate_hz, ResponseOf(o)), throttle, cut.drive.rate_hz,
                          ResponseOf(o));
       }},
      {"brake_onset_s", family, "time to the brake's onset", "first travel above brake_onset", kResponseTraps, kGreen,
       kResponseOptions,
       [](const DriveCut& cut, const OptionValues& o) {
         const Series brake = cut(cut.drive.brake);
         return AsMeasure(BrakeOnset(brake, cut.drive.rate_hz, ResponseOf(o)), brake, cut.drive.rate_hz, ResponseOf(o));
       }},
      {"movement_time_s", family, "time from the released accelerator to the brake's onset",
       "difference of the two times", kResponseTraps, kGreen, kResponseOptions,
       [](const DriveCut& cut, const OptionValues& o) {
         const Series brake = cut(cut.drive.brake);
         return AsMeasure(MovementTime(cut(cut.drive.throttle), brake, cut.drive.rate_hz, ResponseOf(o)), brake,
                          cut.drive.rate_hz, ResponseOf(o));
       }},
      {"steering_onset_s", family, "time to the first steering response",
       "|angle - angle at the begin| > steering_deg, held", kResponseTraps, kGreen, kResponseOptions,
       [](const DriveCut& cut, const OptionValues& o) {
         const Series wheel = cut(cut.drive.steering_wheel_deg);
         return AsMeasure(SteeringOnset(wheel, cut.drive.rate_hz, ResponseOf(o)), wheel, cut.drive.rate_hz,
                          ResponseOf(o));
       }},
      {"first_response_s", family, "time to the first of release, brake and steering", "minimum of the three",
       kResponseTraps, kGreen, kResponseOptions,
       [](const DriveCut& cut, const OptionValues& o) {
         return AsMeasure(FirstResponseIn(cut, ResponseOf(o)), cut(cut.drive.steering_wheel_deg), cut.drive.rate_hz,
                          ResponseOf(o));
       }},
      {"full_brake_time_s", family, "time from the brake's onset to its full travel",
       "to full_brake_share of the largest travel in the interval", kResponseTraps, kGreen, WithFullBrake(),
       [](const DriveCut& cut, const OptionValues& o) {
         ResponseOptions options = ResponseOf(o);
         options.full_brake_share = o["full_brake_share"];
         const Series brake = cut(cut.drive.brake);
         return AsMeasure(TimeToFullBrake(brake, cut.drive.rate_hz, options), brake, cut.drive.rate_hz, options);
       }},
      {"speed_at_begin_mps",
       family,
       "speed at the interval's begin",
       "v of the first sample",
       kAtTraps,
       kGreen,
       {},
       [](const DriveCut& cut, const OptionValues&) { return AtBegin<SpeedAt>(cut, "m/s"); }},
      {"gap_at_begin_m",
       family,
       "gap at the interval's begin",
       "gap of the first sample, of any leader",
       kAtTraps,
       kGreen,
       {},
       [](const DriveCut& cut, const OptionValues&) { return AtBegin<GapAt>(cut, "m"); }},
      {"ttc_at_begin_s",
       family,
       "time to collision at the interval's begin",
       "gap / (v - v_leader) of the first sample",
       kAtTraps,
       kGreen,
       {},
       [](const DriveCut& cut, const OptionValues&) { return AtBegin<TtcAt>(cut, "s"); }},
      {"speed_at_response_mps", family, "speed at the first response", "v at first_response_s", kResponseTraps, kGreen,
       kResponseOptions, [](const DriveCut& cut, const OptionValues& o) { return AtResponse<SpeedAt>(cut, o, "m/s"); }},
      {"gap_at_response_m", family, "gap at the first response", "gap at first_response_s", kResponseTraps, kGreen,
       kResponseOptions, [](const DriveCut& cut, const OptionValues& o) { return AtResponse<GapAt>(cut, o, "m"); }},
      {"ttc_at_response_s", family, "time to collision at the first response", "TTC at first_response_s",
       kResponseTraps, kGreen, kResponseOptions,
       [](const DriveCut& cut, const OptionValues& o) { return AtResponse<TtcAt>(cut, o, "s"); }},
  };
}

}  // namespace rodeira::measures
