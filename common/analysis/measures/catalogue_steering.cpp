// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/catalogue.hpp"
#include "common/analysis/measures/reversals.hpp"
#include "common/analysis/measures/statistics.hpp"
#include "common/analysis/measures/steering.hpp"
#include "common/analysis/measures/steering_entropy.hpp"

namespace rodeira::measures {
namespace {

Series WheelIn(const DriveCut& cut) { return cut(cut.drive.steering_wheel_deg); }

Measure ReversalsIn(const DriveCut& cut, const OptionValues& o) {
  return ReversalRate(WheelIn(cut), cut.drive.rate_hz, {o["cutoff_hz"], o["gap_deg"]});
}

// By a method that needs the driver's baseline.
template <class Method>
Measure EntropyIn(const DriveCut& cut, const char* unit, const Method& method) {
  const std::size_t all = cut.to - cut.from;
  if (!cut.baseline) return NotFound("no interval is named as the baseline", unit, 0, all);
  const auto [from, to] = *cut.baseline;
  if (from == to) return NotFound("the baseline is not in this recording", unit, 0, all);
  return method(WheelIn(cut), Part(cut.drive.steering_wheel_deg, from, to), cut.drive.rate_hz);
}

std::vector<OptionInfo> ReversalOptionsFor(double cutoff_hz, double gap_deg) {
  return {{"cutoff_hz", cutoff_hz, 0.01, 50, "of the low-pass"},
          {"gap_deg", gap_deg, 0, 360, "a reversal is larger, at the steering wheel"}};
}

constexpr const char* kReversalEquation =
    "stationary points of the low-passed angle (Butterworth order 2, both ways); reversals larger than the gap / time";
constexpr const char* kReversalTraps = "degrees of the steering wheel, not of the road wheels; strictly larger";

}  // namespace

std::vector<MeasureInfo> SteeringMeasures() {
  const char* family = "steering";
  return {
      {"reversal_rate_visual_1pmin", family, "steering wheel reversals a minute, of visual load", kReversalEquation,
       kReversalTraps, "Markkula & Engstroem 2006", ReversalOptionsFor(0.6, 3.0), ReversalsIn},
      {"reversal_rate_cognitive_1pmin", family, "the same, of cognitive load", kReversalEquation, kReversalTraps,
       "Markkula & Engstroem 2006", ReversalOptionsFor(2.0, 0.1), ReversalsIn},
      {"steering_entropy_1999",
       family,
       "steering entropy by Nakayama et al., 0 to 1",
       "-sum p log9 p of nine bins of the prediction errors",
       "needs the driver's baseline; not to be compared with the method of 2005",
       "SAE 1999-01-0892",
       {},
       [](const DriveCut& cut, const OptionValues&) { return EntropyIn(cut, "1", SteeringEntropy1999); }},
      {"steering_entropy_2005_bit",
       family,
       "steering entropy by Boer et al.",
       "-sum p log2 p_baseline of 14 bins",
       "needs a baseline of 90 s; a cross entropy, so that unusual steering weighs more",
       "Boer et al. 2005",
       {},
       [](const DriveCut& cut, const OptionValues&) { return EntropyIn(cut, "bit", SteeringEntropy2005); }},
      {"steering_sd_deg",
       family,
       "standard deviation of the steering wheel's angle",
       "SD of the angle",
       "bends of the road are in it",
       "SAE J2944",
       {{"ddof", 1, 0, 1, "0: divided by n, 1: by n - 1"}},
       [](const DriveCut& cut, const OptionValues& o) {
         return DeviationOf(WheelIn(cut), "deg", o["ddof"] == 0.0 ? Denominator::kN : Denominator::kNMinus1);
       }},
      {"steering_rate_mean_degps",
       family,
       "mean magnitude of the steering wheel's rate",
       "mean of |d angle / dt|",
       "grows with the noise of the angle",
       "SAE J2944",
       {},
       [](const DriveCut& cut, const OptionValues&) { return MeanSteeringRate(WheelIn(cut), cut.drive.rate_hz); }},
      {"steering_still_share",
       family,
       "share of time in which the steering wheel is held still",
       "share of |rate| < threshold",
       "depends on the resolution of the angle",
       "Green et al. 2024",
       {{"still_degps", 1, 0.001, 100, "below this rate it is held still"}},
       [](const DriveCut& cut, const OptionValues& o) {
         return SteeringStillShare(WheelIn(cut), cut.drive.rate_hz, o["still_degps"]);
       }},
      {"steering_hfc_share",
       family,
       "high-frequency component of steering",
       "power in the band / power up to its end",
       "the band differs between authors",
       "McLean & Hoffmann 1975",
       {{"from_hz", 0.3, 0.01, 5, "lower end of the band"},
        {"to_hz", 0.6, 0.02, 5, "upper end of the band"},
        {"segment_s", 60, 1, 600, "of Welch's estimate"}},
       [](const DriveCut& cut, const OptionValues& o) {
         return HighFrequencySteering(WheelIn(cut), cut.drive.rate_hz, {o["from_hz"], o["to_hz"], o["segment_s"]});
       }},
  };
}

}  // namespace rodeira::measures
