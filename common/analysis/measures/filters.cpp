// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/filters.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/core/base/assert.hpp"

namespace rodeira::measures {
namespace {

// The poles of both filters; b0 of the low-pass is c^2 times `gain`, of the high-pass `gain` alone.
struct ButterworthPoles {
  double c, gain, a1, a2;
};

ButterworthPoles PolesAt(double cutoff_hz, double rate_hz) {
  RODEIRA_ASSERT(IsCutoff(cutoff_hz, rate_hz));
  const double c = std::tan(std::numbers::pi * cutoff_hz / rate_hz);
  const double gain = 1.0 / (1.0 + std::numbers::sqrt2 * c + c * c);
  return {c, gain, 2.0 * (c * c - 1.0) * gain, (1.0 - std::numbers::sqrt2 * c + c * c) * gain};
}

// Transposed direct form II, in place, from the steady state of a constant input of the first sample.
void RunSection(const SecondOrderSection& s, std::span<double> x) {
  if (x.empty()) return;
  const double gain_at_rest = (s.b0 + s.b1 + s.b2) / (1.0 + s.a1 + s.a2);
  double z2 = (s.b2 - s.a2 * gain_at_rest) * x[0];
  double z1 = (s.b1 - s.a1 * gain_at_rest) * x[0] + z2;
  for (double& value : x) {
    const double in = value;
    const double out = s.b0 * in + z1;
    z1 = s.b1 * in - s.a1 * out + z2;
    z2 = s.b2 * in - s.a2 * out;
    value = out;
  }
}

}  // namespace

bool IsCutoff(double cutoff_hz, double rate_hz) { return cutoff_hz > 0.0 && cutoff_hz < 0.5 * rate_hz; }

SecondOrderSection ButterworthLowPass(double cutoff_hz, double rate_hz) {
  const auto p = PolesAt(cutoff_hz, rate_hz);
  const double b = p.c * p.c * p.gain;
  return {b, 2.0 * b, b, p.a1, p.a2};
}

SecondOrderSection ButterworthHighPass(double cutoff_hz, double rate_hz) {
  const auto p = PolesAt(cutoff_hz, rate_hz);
  return {p.gain, -2.0 * p.gain, p.gain, p.a1, p.a2};
}

std::vector<double> FilterForward(const SecondOrderSection& section, Series x) {
  std::vector<double> y(x.begin(), x.end());
  RunSection(section, y);
  return y;
}

std::size_t PaddingSamples(double padding_s, double rate_hz) {
  return static_cast<std::size_t>(std::llround(std::max(0.0, padding_s * rate_hz)));
}

std::vector<double> FilterBothWays(const SecondOrderSection& section, Series x, std::size_t padding) {
  const std::size_t n = x.size();
  if (n <= padding) return {};
  std::vector<double> y(n + 2 * padding);
  for (std::size_t i = 0; i < padding; ++i) {
    y[i] = 2.0 * x[0] - x[padding - i];
    y[padding + n + i] = 2.0 * x[n - 1] - x[n - 2 - i];
  }
  std::copy(x.begin(), x.end(), y.begin() + static_cast<std::ptrdiff_t>(padding));
  RunSection(section, y);
  std::reverse(y.begin(), y.end());
  RunSection(section, y);
  std::reverse(y.begin(), y.end());
  const auto from = y.begin() + static_cast<std::ptrdiff_t>(padding);
  return {from, from + static_cast<std::ptrdiff_t>(n)};
}

std::vector<SampleRun> ValidRuns(Series x) {
  std::vector<SampleRun> runs;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::isnan(x[i])) continue;
    if (runs.empty() || runs.back().to != i) runs.push_back({i, i});
    runs.back().to = i + 1;
  }
  return runs;
}

std::vector<double> FilterRunsBothWays(const SecondOrderSection& section, Series x, std::size_t padding) {
  std::vector<double> y(x.size(), kMissing);
  for (const SampleRun& run : ValidRuns(x)) {
    const auto part = FilterBothWays(section, x.subspan(run.from, run.size()), padding);
    std::copy(part.begin(), part.end(), y.begin() + static_cast<std::ptrdiff_t>(run.from));
  }
  return y;
}

std::vector<double> Decimate(Series x, std::size_t factor) {
  RODEIRA_ASSERT(factor >= 1);
  std::vector<double> smooth(x.begin(), x.end());
  if (factor > 1) {
    const auto section = ButterworthLowPass(0.4 / static_cast<double>(factor), 1.0);
    const std::size_t padding = kPaddingOfSciPy * factor;
    for (const SampleRun& run : ValidRuns(x)) {
      auto part = FilterBothWays(section, x.subspan(run.from, run.size()), padding);
      if (!part.empty()) part = FilterBothWays(section, part, padding);
      std::copy(part.begin(), part.end(), smooth.begin() + static_cast<std::ptrdiff_t>(run.from));
    }
  }
  std::vector<double> y;
  y.reserve(x.size() / factor + 1);
  for (std::size_t i = 0; i < smooth.size(); i += factor) y.push_back(smooth[i]);
  return y;
}

std::vector<double> Resample(Series x, double from_hz, double to_hz) {
  RODEIRA_ASSERT(from_hz > 0.0 && to_hz > 0.0);
  if (x.empty()) return {};
  const double last = static_cast<double>(x.size() - 1);
  // A sample at the very end stays in spite of rounding.
  const auto count = static_cast<std::size_t>(std::floor(last * to_hz / from_hz + 1e-9)) + 1;
  std::vector<double> y(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double at = std::min(static_cast<double>(k) * from_hz / to_hz, last);
    const auto i = static_cast<std::size_t>(at);
    const double share = at - static_cast<double>(i);
    y[k] = share == 0.0 ? x[i] : x[i] + share * (x[i + 1] - x[i]);
  }
  return y;
}

std::vector<double> Derivative(Series x, double rate_hz) {
  std::vector<double> y(x.size(), kMissing);
  for (const SampleRun& run : ValidRuns(x)) {
    if (run.size() < 2) continue;
    for (std::size_t i = run.from; i < run.to; ++i) {
      const std::size_t a = i == run.from ? i : i - 1;
      const std::size_t b = i + 1 == run.to ? i : i + 1;
      y[i] = (x[b] - x[a]) * rate_hz / static_cast<double>(b - a);
    }
  }
  return y;
}

}  // namespace rodeira::measures
