// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace rodeira::traffic {

// Kolmogorov and Smirnov: the largest distance of two distributions stays below 1.63/sqrt(n) in 99 of 100 samples of
// the one.
template <class Distribution>
inline double Distance(const std::vector<double>& sorted, const Distribution& distribution) {
  double most = 0.0;
  const auto n = static_cast<double>(sorted.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const double f = distribution(sorted[i]);
    most = std::max({most, std::fabs(static_cast<double>(i) / n - f), std::fabs(static_cast<double>(i + 1) / n - f)});
  }
  return most * std::sqrt(n);
}

}  // namespace rodeira::traffic
