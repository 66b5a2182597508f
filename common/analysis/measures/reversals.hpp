// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "common/analysis/measures/filters.hpp"
#include "common/analysis/measures/measure.hpp"

namespace rodeira::measures {

// Steering wheel reversals (Markkula & Engstroem 2006, the method of SAE J2944). Visual load: 0.6 Hz and 3 degrees;
// cognitive load: 2 Hz and 0.1 degrees.
struct ReversalOptions {
  double cutoff_hz = 0.6;
  double gap_deg = 3.0;                    // of the steering wheel; a reversal is larger
  double padding_s = kPaddingOfAuthors_s;  // at each end; of one time at every rate
};

// Reversals of a low-passed angle in both directions. An upward one goes from a stationary point to a later one that
// lies more than the gap above; the search goes on from there. A stationary point is the first sample, or one where the
// sign of the difference changes or the difference is 0.
std::size_t CountReversals(Series smooth_deg, double gap_deg);

// Reversals a minute: low-pass (Butterworth order 2, forward and backward), count, by (n - 1) / rate. Runs of valid
// samples are counted one by one.
Measure ReversalRate(Series wheel_deg, double rate_hz, const ReversalOptions& options);

}  // namespace rodeira::measures
