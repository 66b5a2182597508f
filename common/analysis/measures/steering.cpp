// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/steering.hpp"

#include <algorithm>
#include <cmath>

#include "common/analysis/measures/spectrum.hpp"

namespace rodeira::measures {
namespace {

std::vector<double> AbsoluteRate(Series wheel_deg, double rate_hz) {
  std::vector<double> rate = Derivative(wheel_deg, rate_hz);
  for (double& value : rate) value = std::abs(value);
  return rate;
}

}  // namespace

Measure MeanSteeringRate(Series wheel_deg, double rate_hz) { return MeanOf(AbsoluteRate(wheel_deg, rate_hz), "deg/s"); }

Measure SteeringStillShare(Series wheel_deg, double rate_hz, double still_degps) {
  Measure share = ShareBelow(AbsoluteRate(wheel_deg, rate_hz), still_degps);
  share.options = Used({{"still_degps", still_degps}});
  return share;
}

Measure HighFrequencySteering(Series wheel_deg, double rate_hz, const HighFrequencyOptions& options) {
  const std::size_t all = wheel_deg.size();
  // Ten times the band's end is enough: the sums below cost the rate.
  const auto factor = std::max<std::size_t>(1, static_cast<std::size_t>(rate_hz / (20.0 * options.to_hz)));
  const std::vector<double> slow = Decimate(wheel_deg, factor);
  const double slow_hz = rate_hz / static_cast<double>(factor);
  const auto wanted = static_cast<std::size_t>(std::llround(options.segment_s * slow_hz));
  const std::size_t segment = std::min(wanted, slow.size());
  UsedOptions used = Used({{"from_hz", options.from_hz},
                           {"to_hz", options.to_hz},
                           {"window", "Hann"},
                           {"overlap", 0.5},
                           {"segment_s", static_cast<double>(segment) / slow_hz}});
  if (options.to_hz >= 0.5 * slow_hz || static_cast<double>(segment) * options.from_hz < 3.0 * slow_hz)
    return NotFound("too short: three cycles of the band's lower end were expected", "1", 0, all, used);
  const Spectrum spectrum = WelchSpectrum(slow, slow, slow_hz, segment, options.to_hz);
  double high = 0.0, total = 0.0;
  for (const SpectrumBin& bin : spectrum.bins) {
    total += bin.x;
    if (bin.frequency_hz >= options.from_hz * (1.0 - 1e-12)) high += bin.x;
  }
  const std::size_t n = CountValid(wheel_deg);
  if (spectrum.segments == 0) return NotFound("no segment without a missing sample", "1", 0, all, used);
  if (!(total > 0.0)) return NotFound("the steering wheel does not move", "1", n, all, used);
  return Found(high / total, "1", n, all, used);
}

}  // namespace rodeira::measures
