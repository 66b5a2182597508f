// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "common/analysis/measures/measure.hpp"

// Steering entropy by its two methods. They give other numbers: name the method, and the baseline of the driver.
namespace rodeira::measures {

// --- Nakayama, Futami, Nakamura & Boer 1999 (SAE 1999-01-0892) ---

// The angle every 150 ms: the mean of the samples of each 150 ms. Missing where one of them is.
std::vector<double> At150ms(Series wheel_deg, double rate_hz);
// e = angle - prediction by the second-order Taylor series: 2.5, -2, 0.5 of the three angles before. Empty for fewer
// than four angles; missing where one of the four is.
std::vector<double> TaylorErrors(Series angle_deg);
// alpha: the 90th percentile (type 7) of |e| of the driver's baseline.
std::optional<double> EntropyAlpha(Series baseline_errors_deg);
// -sum(p log9 p) of nine bins cut at -5 -2.5 -1 -0.5 0.5 1 2.5 5 alpha, 0 to 1.
Measure Entropy1999(Series errors_deg, double alpha_deg);
// All of it: the baseline's alpha, the task's errors.
Measure SteeringEntropy1999(Series wheel_deg, Series baseline_deg, double rate_hz);

// --- Boer, Rakauskas, Ward & Goodrich 2005 ---

inline constexpr double kEntropyRate_hz = 4.0;
// Low-pass at 3/7 of 4 Hz (Butterworth order 2, forward and backward), then 4 Hz. Empty where the series is too short.
std::vector<double> At4Hz(Series wheel_deg, double rate_hz);
// Coefficients a of x[n] = a0 x[n-1] + a1 x[n-2] + a2 x[n-3] + e by Burg's method. Nothing for fewer than 8 samples.
std::optional<std::array<double, 3>> BurgAr3(Series x);
// The errors e; the first three samples have none.
std::vector<double> ArErrors(Series x, const std::array<double, 3>& a);
// Shares of the 14 bins cut at 0, +-1 ... +-6 pe, the outer ones open, each at least 1e-3.
using EntropyShares = std::array<double, 14>;
// Precondition: pe_deg is over 0.
EntropyShares SharesOf(Series errors_deg, double pe_deg);
// pe: half the sum of the magnitudes of the 20th and the 80th percentile (type 7).
std::optional<double> EntropyPe(Series errors_deg);
// -sum(p log2 q) in bit: of the baseline with itself, or of a task's shares p with the baseline's q.
double CrossEntropy_bit(const EntropyShares& p, const EntropyShares& q);
// All of it: the first minute of the baseline gives the predictor, the second one pe and its shares. Missing for a
// baseline shorter than 90 s.
Measure SteeringEntropy2005(Series wheel_deg, Series baseline_deg, double rate_hz);

}  // namespace rodeira::measures
