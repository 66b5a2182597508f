// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/core/base/assert.hpp"

namespace rodeira::measures {
namespace {

constexpr const char* kNoValidSample = "no valid sample";

struct SquareSum {
  std::size_t n = 0;
  double squares = 0.0;  // about the mean
};

SquareSum SquaresOf(Series x) {
  SquareSum sum;
  const auto mean = Mean(x);
  if (!mean) return sum;
  for (const double value : x) {
    if (std::isnan(value)) continue;
    ++sum.n;
    sum.squares += (value - *mean) * (value - *mean);
  }
  return sum;
}

std::size_t Divisor(std::size_t n, Denominator denominator) {
  return denominator == Denominator::kN || n == 0 ? n : n - 1;
}

template <class Holds>
Measure ShareWhere(Series x, double threshold, const Holds& holds) {
  const std::size_t n = CountValid(x);
  const UsedOptions options = Used({{"threshold", threshold}});
  if (n == 0) return NotFound(kNoValidSample, "1", 0, x.size(), options);
  const auto count = std::count_if(x.begin(), x.end(), holds);
  return Found(static_cast<double>(count) / static_cast<double>(n), "1", n, x.size(), options);
}

}  // namespace

const char* NameOf(Denominator denominator) { return denominator == Denominator::kN ? "n" : "n-1"; }

std::size_t CountValid(Series x) {
  return static_cast<std::size_t>(std::count_if(x.begin(), x.end(), [](double v) { return !std::isnan(v); }));
}

std::optional<double> Mean(Series x) {
  double sum = 0.0;
  std::size_t n = 0;
  for (const double value : x) {
    if (std::isnan(value)) continue;
    sum += value;
    ++n;
  }
  if (n == 0) return std::nullopt;
  return sum / static_cast<double>(n);
}

std::optional<double> Deviation(Series x, Denominator denominator) {
  const SquareSum sum = SquaresOf(x);
  const std::size_t divisor = Divisor(sum.n, denominator);
  if (divisor == 0) return std::nullopt;
  return std::sqrt(sum.squares / static_cast<double>(divisor));
}

std::optional<double> Minimum(Series x) {
  std::optional<double> least;
  for (const double value : x) {
    if (!std::isnan(value) && (!least || value < *least)) least = value;
  }
  return least;
}

std::optional<double> Maximum(Series x) {
  std::optional<double> most;
  for (const double value : x) {
    if (!std::isnan(value) && (!most || value > *most)) most = value;
  }
  return most;
}

std::optional<double> Quantile(Series x, double p) {
  RODEIRA_ASSERT(p >= 0.0 && p <= 1.0);
  std::vector<double> sorted;
  sorted.reserve(x.size());
  std::copy_if(x.begin(), x.end(), std::back_inserter(sorted), [](double v) { return !std::isnan(v); });
  if (sorted.empty()) return std::nullopt;
  const double at = p * static_cast<double>(sorted.size() - 1);
  const auto i = static_cast<std::size_t>(at);
  const auto low = sorted.begin() + static_cast<std::ptrdiff_t>(i);
  std::nth_element(sorted.begin(), low, sorted.end());
  const double share = at - static_cast<double>(i);
  if (share == 0.0 || i + 1 == sorted.size()) return *low;
  const double next = *std::min_element(low + 1, sorted.end());
  return *low + share * (next - *low);
}

std::optional<double> WeightedMean(Series x, Series weights) {
  RODEIRA_ASSERT(x.size() == weights.size());
  double sum = 0.0, weight = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::isnan(x[i]) || std::isnan(weights[i])) continue;
    sum += weights[i] * x[i];
    weight += weights[i];
  }
  if (weight == 0.0) return std::nullopt;
  return sum / weight;
}

std::optional<double> PooledDeviation(Series x, std::span<const SampleRun> parts, Denominator denominator) {
  double squares = 0.0;
  std::size_t divisor = 0;
  for (const SampleRun& part : parts) {
    const SquareSum sum = SquaresOf(x.subspan(part.from, part.size()));
    const std::size_t own = Divisor(sum.n, denominator);
    if (own == 0) continue;
    squares += sum.squares;
    divisor += own;
  }
  if (divisor == 0) return std::nullopt;
  return std::sqrt(squares / static_cast<double>(divisor));
}

std::optional<double> CircularMean(Series angle_rad) {
  double sine = 0.0, cosine = 0.0;
  std::size_t n = 0;
  for (const double angle : angle_rad) {
    if (std::isnan(angle)) continue;
    sine += std::sin(angle);
    cosine += std::cos(angle);
    ++n;
  }
  constexpr double kCancelled = 1e-9;
  if (n == 0 || std::hypot(sine, cosine) < kCancelled * static_cast<double>(n)) return std::nullopt;
  return std::atan2(sine, cosine);
}

double WrapAngle(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2.0 * std::numbers::pi);
  return wrapped <= -std::numbers::pi ? std::numbers::pi : wrapped;
}

double NormalShare(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

Measure MeanOf(Series x, const char* unit) { return FoundOr(Mean(x), kNoValidSample, unit, CountValid(x), x.size()); }

Measure DeviationOf(Series x, const char* unit, Denominator denominator) {
  return FoundOr(Deviation(x, denominator), "too few valid samples", unit, CountValid(x), x.size(),
                 Used({{"denominator", NameOf(denominator)}}));
}

Measure MinimumOf(Series x, const char* unit) {
  return FoundOr(Minimum(x), kNoValidSample, unit, CountValid(x), x.size());
}

Measure MaximumOf(Series x, const char* unit) {
  return FoundOr(Maximum(x), kNoValidSample, unit, CountValid(x), x.size());
}

Measure QuantileOf(Series x, const char* unit, double p) {
  return FoundOr(Quantile(x, p), kNoValidSample, unit, CountValid(x), x.size(),
                 Used({{"percent", 100.0 * p}, {"percentile_type", 7}}));
}

Measure ShareBelow(Series x, double threshold) {
  return ShareWhere(x, threshold, [threshold](double v) { return v < threshold; });
}

Measure ShareAbove(Series x, double threshold) {
  return ShareWhere(x, threshold, [threshold](double v) { return v > threshold; });
}

}  // namespace rodeira::measures
