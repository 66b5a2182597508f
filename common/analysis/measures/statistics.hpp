// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "common/analysis/measures/filters.hpp"
#include "common/analysis/measures/measure.hpp"

namespace rodeira::measures {

// What the sum of squares is divided by. SAE J2944 wants it stated.
enum class Denominator { kN, kNMinus1 };
// As it stands in a measure's options.
const char* NameOf(Denominator denominator);

// Missing samples are left out. Nothing where too few are left: one for a mean, a quantile or an extreme, and for a
// deviation one (kN) or two (kNMinus1).
std::size_t CountValid(Series x);
std::optional<double> Mean(Series x);
std::optional<double> Deviation(Series x, Denominator denominator);
std::optional<double> Minimum(Series x);
std::optional<double> Maximum(Series x);
// The quantile of type 7, the default of R, NumPy and pandas: linear between the order statistics. p is 0 to 1.
std::optional<double> Quantile(Series x, double p);
// Weighted mean; samples without a value or weight are left out. Nothing where the weights add up to 0.
std::optional<double> WeightedMean(Series x, Series weights);

// The deviation about each part's own mean, pooled: sqrt(sum((n_i - 1) s_i^2) / sum(n_i - 1)); with kN both n_i.
// Parts without a deviation are left out.
std::optional<double> PooledDeviation(Series x, std::span<const SampleRun> parts, Denominator denominator);

// The mean of angles by their directions, in (-pi, pi]; nothing where they cancel.
std::optional<double> CircularMean(Series angle_rad);
// An angle, or a difference of angles, in (-pi, pi].
double WrapAngle(double angle_rad);

// The standard normal distribution's share below z.
double NormalShare(double z);

// As measures.
Measure MeanOf(Series x, const char* unit);
Measure DeviationOf(Series x, const char* unit, Denominator denominator);
Measure MinimumOf(Series x, const char* unit);
Measure MaximumOf(Series x, const char* unit);
// p from 0 to 1.
Measure QuantileOf(Series x, const char* unit, double p);
// The share of the valid samples that lie below a threshold, or above it.
Measure ShareBelow(Series x, double threshold);
Measure ShareAbove(Series x, double threshold);

}  // namespace rodeira::measures
