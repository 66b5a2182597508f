// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/vehicle/dynamics/tyre_model.hpp"

namespace rodeira::dynamics {

// Names are those of the files, in lower case.
struct FialaSettings {
  double cslip_N = 0.0;   // longitudinal force a slip
  double calpha_N = 0.0;  // side force a radian of slip angle
  double umin = 0.0;      // friction at full slip
  double umax = 0.0;      // friction without slip; at least umin
};

// E. Fiala's tyre as multibody programs have it (Adams/Tire, Fiala Tire Model). With s = |(kappa, tan alpha)|, at most
// 1, the friction is U = umax - (umax - umin) s. Longitudinally the force is CSLIP kappa up to |kappa| = U Fz / (2
// CSLIP), then U Fz - (U Fz)² / (4 CSLIP |kappa|). Laterally it is U Fz (1 - H³) with H = 1 - CALPHA |tan alpha| / (3 U
// Fz), and U Fz where H < 0. Camber has no effect.
class FialaTyre final : public TyreModel {
 public:
  explicit FialaTyre(const FialaSettings& settings) : settings_(settings) {}
  TyreForces Forces(const TyreSlip& slip, double load_N, double friction) const override;
  double LongitudinalStiffness(double load_N) const override;
  double CorneringStiffness(double load_N) const override;
  double LongitudinalPeak(double load_N, double friction) const override;
  double LateralPeak(double load_N, double friction) const override;

 private:
  FialaSettings settings_;
};

}  // namespace rodeira::dynamics
