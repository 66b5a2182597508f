// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "common/analysis/measures/measure.hpp"

namespace rodeira::measures {

// y[n] = b0 x[n] + b1 x[n-1] + b2 x[n-2] - a1 y[n-1] - a2 y[n-2]
struct SecondOrderSection {
  double b0 = 1.0, b1 = 0.0, b2 = 0.0;
  double a1 = 0.0, a2 = 0.0;
};

// Butterworth filters of order 2 by the bilinear transform with the cut-off prewarped: -3 dB at cutoff_hz in one pass,
// -6 dB forward and backward. Precondition: 0 < cutoff_hz < rate_hz / 2.
SecondOrderSection ButterworthLowPass(double cutoff_hz, double rate_hz);
SecondOrderSection ButterworthHighPass(double cutoff_hz, double rate_hz);
// Whether that precondition holds.
bool IsCutoff(double cutoff_hz, double rate_hz);

// Samples by which FilterBothWays extends a series at each end: filtfilt of SciPy, 3 times the number of coefficients.
inline constexpr std::size_t kPaddingOfSciPy = 9;
// The same at the 100 Hz of a drive, as a time: one padding at every rate.
inline constexpr double kPadding_s = 0.09;
// The 6 samples of MATLAB's filtfilt at the 30 Hz of the authors' steering recordings, as a time: counts near the ends
// depend on it, and with a number of samples they would depend on the rate.
inline constexpr double kPaddingOfAuthors_s = 0.2;
// Whole samples, for FilterBothWays.
std::size_t PaddingSamples(double padding_s, double rate_hz);

// Forward in time only, from the steady state of the first sample. Precondition: no sample is missing.
std::vector<double> FilterForward(const SecondOrderSection& section, Series x);
// Forward and backward: no phase. The ends are extended by `padding` samples, reflected about the end's point, and each
// pass starts from the steady state of its first sample. Empty where x has no more than `padding` samples.
// Precondition: no sample is missing.
std::vector<double> FilterBothWays(const SecondOrderSection& section, Series x, std::size_t padding);

// A run [from, to) of samples that are not missing.
struct SampleRun {
  std::size_t from = 0, to = 0;

  std::size_t size() const { return to - from; }
};
// Runs without a missing sample, ascending.
std::vector<SampleRun> ValidRuns(Series x);
// FilterBothWays in each run of valid samples; shorter runs, and what is missing, are missing.
std::vector<double> FilterRunsBothWays(const SecondOrderSection& section, Series x, std::size_t padding);

// Every `factor`th sample from the first on, behind a low-pass without phase: Butterworth of order 2 at 0.4 times the
// new rate, twice forward and backward (-12 dB there). In runs that are too short for the filter the samples are taken
// as they are. Precondition: factor >= 1.
std::vector<double> Decimate(Series x, std::size_t factor);

// Linear interpolation to another rate: sample k lies at k / to_hz. Missing beside a missing sample. Precondition: both
// rates are above 0.
std::vector<double> Resample(Series x, double from_hz, double to_hz);

// The central difference quotient, one-sided at the ends of a run of valid samples; missing in a run of one.
std::vector<double> Derivative(Series x, double rate_hz);

}  // namespace rodeira::measures
