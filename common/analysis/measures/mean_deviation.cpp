// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/mean_deviation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/analysis/measures/statistics.hpp"
#include "common/core/base/assert.hpp"

namespace rodeira::measures {
namespace {

// The integral of |x| over a piece of length ds on which x is linear.
double AbsoluteIntegral(double x0, double x1, double ds) {
  if (x0 * x1 >= 0.0) return 0.5 * (std::abs(x0) + std::abs(x1)) * ds;
  return 0.5 * (x0 * x0 + x1 * x1) / (std::abs(x0) + std::abs(x1)) * ds;
}

// t at a station that the samples pass; nothing where they do not.
std::optional<double> LateralAt(Series s_m, Series t_m, double at_s_m) {
  for (std::size_t i = 1; i < s_m.size(); ++i) {
    if (!(s_m[i - 1] <= at_s_m && s_m[i] > at_s_m)) continue;
    const double t = t_m[i - 1] + (at_s_m - s_m[i - 1]) / (s_m[i] - s_m[i - 1]) * (t_m[i] - t_m[i - 1]);
    if (!std::isnan(t)) return t;
  }
  return std::nullopt;
}

}  // namespace

double ReferenceAt(double s_m, std::span<const LaneChangeSign> signs, const ReferencePath& path) {
  double t = path.start_t_m;
  for (const LaneChangeSign& sign : signs) {
    const double done = std::clamp((s_m - (sign.s_m - path.before_m)) / path.length_m, 0.0, 1.0);
    t += done * (sign.target_t_m - t);
  }
  return t;
}

Measure MeanDeviation(Series s_m, Series t_m, double from_s_m, double to_s_m, std::span<const LaneChangeSign> signs,
                      const ReferencePath& path) {
  RODEIRA_ASSERT(s_m.size() == t_m.size());
  const UsedOptions used = Used({{"from_s_m", from_s_m},
                                 {"to_s_m", to_s_m},
                                 {"before_m", path.before_m},
                                 {"length_m", path.length_m},
                                 {"signs", static_cast<int>(signs.size())},
                                 {"mean", "over distance"}});
  // The reference's corners lie between samples: a piece is cut at them.
  std::vector<double> corners{from_s_m, to_s_m};
  for (const LaneChangeSign& sign : signs) {
    corners.push_back(sign.s_m - path.before_m);
    corners.push_back(sign.s_m - path.before_m + path.length_m);
  }
  std::sort(corners.begin(), corners.end());
  double integral = 0.0, way = 0.0;
  std::size_t n = 0;
  for (std::size_t i = 1; i < s_m.size(); ++i) {
    const double low = std::max(s_m[i - 1], from_s_m), high = std::min(s_m[i], to_s_m);
    if (!(high > low) || std::isnan(t_m[i - 1] + t_m[i])) continue;
    ++n;
    const auto deviation = [&](double s) {
      const double t = t_m[i - 1] + (s - s_m[i - 1]) / (s_m[i] - s_m[i - 1]) * (t_m[i] - t_m[i - 1]);
      return t - ReferenceAt(s, signs, path);
    };
    double at = low;
    for (auto corner = std::upper_bound(corners.begin(), corners.end(), low); at < high; ++corner) {
      const double next = corner == corners.end() ? high : std::min(*corner, high);
      integral += AbsoluteIntegral(deviation(at), deviation(next), next - at);
      at = next;
    }
    way += high - low;
  }
  if (!(way > 0.0)) return NotFound("the vehicle does not pass the stretch", "m", n, s_m.size(), used);
  return Found(integral / way, "m", n, s_m.size(), used);
}

Measure CorrectChanges(Series s_m, Series t_m, std::span<const LaneChangeSign> signs, double half_lane_m, double by_m) {
  const UsedOptions used = Used({{"half_lane_m", half_lane_m}, {"by_m", by_m}});
  std::size_t passed = 0, correct = 0;
  for (const LaneChangeSign& sign : signs) {
    const auto t = LateralAt(s_m, t_m, sign.s_m + by_m);
    if (!t) continue;
    ++passed;
    if (std::abs(*t - sign.target_t_m) < half_lane_m) ++correct;
  }
  if (passed == 0) return NotFound("no sign is passed", "1", 0, signs.size(), used);
  return Found(static_cast<double>(correct) / static_cast<double>(passed), "1", passed, signs.size(), used);
}

}  // namespace rodeira::measures
