// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "common/vehicle/dynamics/tyre_model.hpp"

namespace rodeira::dynamics {

// A direction of a TMeasy tyre at the nominal load and at twice that.
struct TmeasyDirection {
  std::array<double, 2> slope_N{};     // dF0: force a slip without slip
  std::array<double, 2> maximum_N{};   // FM
  std::array<double, 2> sliding_N{};   // FS
  std::array<double, 2> slip_max{};    // sM, where the force is largest
  std::array<double, 2> slip_slide{};  // sS, where the tyre slides; over sM
};
// nominal_N: the load of the first number of each pair; the second one belongs to twice that.
struct TmeasySettings {
  double nominal_N = 0.0;
  double largest_N = 0.0;  // loads above it count as this one
  TmeasyDirection longitudinal, lateral;
};

// G. Rill's TMeasy (Road Vehicle Dynamics, chapter 3.3). Forces between the two loads are parabolas through 0, slips
// straight lines. The slips are over the speed of transport, r |omega|: sx = kappa / |1 + kappa| and sy = -tan alpha /
// |1 + kappa|. Both ways together act along (sx, sy); each parameter of that direction is the root of squares of its
// two parts. Ground friction multiplies forces and slips, not the slope. Camber has no effect.
class TmeasyTyre final : public TyreModel {
 public:
  explicit TmeasyTyre(const TmeasySettings& settings) : settings_(settings) {}
  TyreForces Forces(const TyreSlip& slip, double load_N, double friction) const override;
  double LongitudinalStiffness(double load_N) const override;
  double CorneringStiffness(double load_N) const override;
  double LongitudinalPeak(double load_N, double friction) const override;
  double LateralPeak(double load_N, double friction) const override;

 private:
  double Ratio(double load_N) const;

  TmeasySettings settings_;
};

}  // namespace rodeira::dynamics
