// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/reversals.hpp"

#include <vector>

namespace rodeira::measures {
namespace {

int SignOf(double x) { return (x > 0.0) - (x < 0.0); }

// Points at which the angle stands still. The last sample is none.
std::vector<double> StationaryPoints(Series x) {
  std::vector<double> points;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const int before = i > 0 ? SignOf(x[i] - x[i - 1]) : 0;
    const int after = SignOf(x[i + 1] - x[i]);
    if (before != after || after == 0) points.push_back(x[i]);  // the first sample counts
  }
  return points;
}

std::size_t CountUpward(const std::vector<double>& points, double gap, double sign) {
  std::size_t count = 0;
  if (points.empty()) return 0;
  double low = sign * points[0];
  for (const double point : points) {
    const double value = sign * point;
    if (value - low > gap) {
      ++count;
      low = value;
    } else if (value <= low) {
      low = value;
    }
  }
  return count;
}

}  // namespace

std::size_t CountReversals(Series smooth_deg, double gap_deg) {
  const std::vector<double> points = StationaryPoints(smooth_deg);
  return CountUpward(points, gap_deg, 1.0) + CountUpward(points, gap_deg, -1.0);
}

Measure ReversalRate(Series wheel_deg, double rate_hz, const ReversalOptions& options) {
  const UsedOptions used = Used({{"cutoff_hz", options.cutoff_hz},
                                 {"gap_deg", options.gap_deg},
                                 {"padding_s", options.padding_s},
                                 {"rate_hz", rate_hz}});
  if (!IsCutoff(options.cutoff_hz, rate_hz))
    return NotFound("the cut-off is not between 0 and half the sample rate", "1/min", 0, wheel_deg.size(), used);
  const auto section = ButterworthLowPass(options.cutoff_hz, rate_hz);
  std::size_t reversals = 0, n = 0, periods = 0;
  for (const SampleRun& run : ValidRuns(wheel_deg)) {
    const auto smooth =
        FilterBothWays(section, wheel_deg.subspan(run.from, run.size()), PaddingSamples(options.padding_s, rate_hz));
    if (smooth.size() < 2) continue;
    reversals += CountReversals(smooth, options.gap_deg);
    n += smooth.size();
    periods += smooth.size() - 1;
  }
  if (periods == 0) return NotFound("too few samples for the filter", "1/min", n, wheel_deg.size(), used);
  const double minutes = static_cast<double>(periods) / rate_hz / 60.0;
  return Found(static_cast<double>(reversals) / minutes, "1/min", n, wheel_deg.size(), used);
}

}  // namespace rodeira::measures
