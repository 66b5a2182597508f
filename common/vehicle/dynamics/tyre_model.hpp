// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/vehicle/dynamics/magic_formula.hpp"

namespace rodeira::dynamics {

// A tyre model besides the Magic Formula and the slip curve. Quantities, units and signs are those of
// magic_formula.hpp: forces at a load, N; `friction` of the ground multiplies the peaks, not the stiffness. A load of 0
// or less bears nothing. Objects do not change and may be shared by threads.
class TyreModel {
 public:
  virtual ~TyreModel() = default;
  // Steady forces; the aligning moment is left at 0.
  virtual TyreForces Forces(const TyreSlip& slip, double load_N, double friction) const = 0;
  // Slopes at zero slip, N, both positive; then the peaks, N.
  virtual double LongitudinalStiffness(double load_N) const = 0;
  virtual double CorneringStiffness(double load_N) const = 0;
  virtual double LongitudinalPeak(double load_N, double friction) const = 0;
  virtual double LateralPeak(double load_N, double friction) const = 0;
};

}  // namespace rodeira::dynamics
