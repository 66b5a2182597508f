// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/spectrum.hpp"

#include <cmath>
#include <numbers>

#include "common/analysis/measures/statistics.hpp"
#include "common/core/base/assert.hpp"

namespace rodeira::measures {
namespace {

// Without its mean, times the periodic Hann window.
std::vector<double> WindowedSegment(Series x) {
  double sum = 0.0;
  for (const double value : x) sum += value;
  const auto n = static_cast<double>(x.size());
  std::vector<double> y(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double window = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / n);
    y[i] = window * (x[i] - sum / n);
  }
  return y;
}

std::complex<double> FourierSum(const std::vector<double>& x, const std::vector<std::complex<double>>& circle,
                                std::size_t cycle) {
  std::complex<double> sum = 0.0;
  std::size_t at = 0;
  for (const double value : x) {
    sum += value * circle[at];
    at = (at + cycle) % circle.size();
  }
  return sum;
}

}  // namespace

Spectrum WelchSpectrum(Series x, Series y, double rate_hz, std::size_t segment, double highest_hz) {
  RODEIRA_ASSERT(x.size() == y.size() && segment >= 4);
  Spectrum spectrum;
  std::vector<std::complex<double>> circle(segment);
  for (std::size_t i = 0; i < segment; ++i)
    circle[i] = std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(segment));
  for (std::size_t cycle = 1; cycle <= segment / 2; ++cycle) {
    const double frequency = static_cast<double>(cycle) * rate_hz / static_cast<double>(segment);
    if (frequency > highest_hz * (1.0 + 1e-12)) break;
    spectrum.bins.push_back({frequency, 0.0, 0.0, 0.0});
  }
  for (std::size_t from = 0; from + segment <= x.size(); from += segment / 2) {
    const Series part_x = x.subspan(from, segment), part_y = y.subspan(from, segment);
    if (CountValid(part_x) < segment || CountValid(part_y) < segment) continue;
    ++spectrum.segments;
    const std::vector<double> in_x = WindowedSegment(part_x), in_y = WindowedSegment(part_y);
    for (std::size_t i = 0; i < spectrum.bins.size(); ++i) {
      const auto fx = FourierSum(in_x, circle, i + 1), fy = FourierSum(in_y, circle, i + 1);
      spectrum.bins[i].x += std::norm(fx);
      spectrum.bins[i].y += std::norm(fy);
      spectrum.bins[i].cross += std::conj(fx) * fy;
    }
  }
  return spectrum;
}

}  // namespace rodeira::measures
