// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "common/analysis/measures/measure.hpp"

namespace rodeira::measures {

// Welch's estimate: segments that overlap by half, each without its mean and with a Hann window. Densities are
// to a common factor.
struct SpectrumBin {
  double frequency_hz = 0.0;
  double x = 0.0, y = 0.0;     // densities of x and y
  std::complex<double> cross;  // of conj(X) Y: its argument is negative where y follows x
};
// Sums over the segments that count; without any they are 0.
struct Spectrum {
  std::size_t segments = 0;
  std::vector<SpectrumBin> bins;  // from one cycle a segment to at most highest_hz
};

// x and y have the same length; a segment with a missing sample is left out. Precondition: segment >= 4.
Spectrum WelchSpectrum(Series x, Series y, double rate_hz, std::size_t segment, double highest_hz);

}  // namespace rodeira::measures
