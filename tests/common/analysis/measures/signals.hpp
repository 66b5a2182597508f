// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

namespace rodeira::measures {

// f(t) at t = 0, 1/rate, ... below `seconds`.
template <class Function>
std::vector<double> Sampled(double seconds, double rate_hz, const Function& f) {
  const auto n = static_cast<std::size_t>(std::llround(seconds * rate_hz));
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = f(static_cast<double>(i) / rate_hz);
  return x;
}

inline std::vector<double> SineWave(double amplitude, double frequency_hz, double seconds, double rate_hz) {
  return Sampled(seconds, rate_hz,
                 [=](double t) { return amplitude * std::sin(2.0 * std::numbers::pi * frequency_hz * t); });
}

// z with the standard normal share p below it, by halving.
inline double NormalQuantile(double p) {
  double low = -10.0, high = 10.0;
  for (int i = 0; i < 80; ++i) {
    const double z = 0.5 * (low + high);
    (0.5 * std::erfc(-z / std::numbers::sqrt2) < p ? low : high) = z;
  }
  return 0.5 * (low + high);
}

// n numbers that are distributed as the normal distribution, in ascending order: its quantiles.
inline std::vector<double> NormalNumbers(std::size_t n, double sigma) {
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i)
    x[i] = sigma * NormalQuantile((static_cast<double>(i) + 0.5) / static_cast<double>(n));
  return x;
}

}  // namespace rodeira::measures
