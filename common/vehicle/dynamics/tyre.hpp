// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "common/core/base/state.hpp"
#include "common/vehicle/dynamics/aligning_moment.hpp"
#include "common/vehicle/dynamics/magic_formula.hpp"
#include "common/vehicle/dynamics/slip_curve.hpp"
#include "common/vehicle/dynamics/tyre_model.hpp"

namespace rodeira::dynamics {

// A tyre of any model, with what the transient slip and the pressure add.
struct TyreSettings {
  MagicFormulaSettings formula;
  std::optional<SlipCurveSettings> slip_curve = std::nullopt;  // where it is there, in the formula's place
  std::shared_ptr<const TyreModel> model = nullptr;            // another one in the formula's place
  std::optional<AligningSettings> aligning = std::nullopt;     // with another model of the forces: the trail only
  double pneumatic_trail_m = 0.0;          // without `aligning`: at no slip; it vanishes as the tyre slides
  double relaxation_longitudinal_m = 0.2;  // sigma_kappa
  double relaxation_lateral_m = 0.4;       // sigma_alpha
  double low_speed_mps = 2.5;  // below it the damping fades in and the deflection is held to what friction bears
  double low_speed_damping_Nspm = 3000.0;  // force a slip speed at standstill, while the tyre does not slide
  // By the pressure (tyre_pressure.hpp): of the wheel's vertical stiffness and rolling resistance, and of the stiffness
  // along and across, by which each slip counts less.
  double vertical_share = 1.0;
  double resistance_share = 1.0;
  double slip_share = 1.0;
};
inline constexpr double kMaxPressureShare = 1.5;

// The tyres of the axles on their wheels, in the order of WheelIndex: one that was measured on the other side of a car
// is mirrored.
std::array<TyreSettings, 4> OnWheels(const std::array<TyreSettings, 2>& axles);

// Of the formula, of the slip curve or of the other model, as in magic_formula.hpp.
TyreForces SteadyForces(const TyreSettings& tyre, const TyreSlip& slip, double load_N, double friction);
// Slopes of the pure forces at zero slip, N: dFx/dkappa and -dFy/dtan(alpha).
double LongitudinalStiffness(const TyreSettings& tyre, double load_N);
double CorneringStiffness(const TyreSettings& tyre, double load_N);
// The largest pure force, N.
double LongitudinalPeak(const TyreSettings& tyre, double load_N, double friction);
double LateralPeak(const TyreSettings& tyre, double load_N, double friction);
// The same forces with the aligning moment of a tyre that rolls forward: by `aligning`, or as side force times
// `pneumatic_trail_m` (1 - |tan alpha| K / (3 D)), at least 0.
TyreForces SteadyForcesWithMoment(const TyreSettings& tyre, const TyreSlip& slip, double load_N, double friction);

// The contact patch that is turned about the road's normal while the tyre does not roll: a square of area load over
// pressure p. Its bristles give it a stiffness of cornering stiffness × half length / 3 (brush model: H. B. Pacejka,
// Tire and Vehicle Dynamics, 3rd ed., 2012, chapter 3.2), and friction bounds its torque to mu/3 sqrt(load³/p) (Gough's
// formula, compared with measurements by R. S. Sharp and R. Granger, Proc. IMechE D 217 (2003) 87-96).
struct TurnedPatch {
  double half_length_m = 0.0;
  double stiffness_Nmprad = 0.0;
  double most_Nm = 0.0;
};
// All 0 without a load.
TurnedPatch TurnedPatchOf(const TyreSettings& tyre, double load_N, double friction);

// How the wheel moves over the ground, in its contact frame.
struct TyreMotion {
  double vx_mps = 0.0;      // of the hub along the wheel
  double vsx_mps = 0.0;     // slip speed along the wheel: vx - spin · rolling radius; positive when braked
  double vsy_mps = 0.0;     // slip speed to the left
  double camber_rad = 0.0;  // about the contact's x axis: positive when the wheel leans to the right
  double turn_radps = 0.0;  // of the wheel's carrier about the contact's z axis, positive to the left
};

// What the forces go by where the wheel rolls steadily (vx not 0), the damping of low speeds included.
TyreSlip SteadySlip(const TyreSettings& tyre, const TyreMotion& motion, double load_N);

// The transient of the formula (or curve) by relaxation of the contact patch's deflections u and v:
//   sigma_k du/dt + |vx| u = -sigma_k vsx,   sigma_a dv/dt + |vx| v = sigma_a vsy,   kappa' = u/sigma_k, tan alpha' =
//   v/sigma_a.
// The steady state is the static table. At standstill the patch is a spring, so that a braked car rests on a slope
// without creeping; below low_speed a damper is added inside of the formula (so friction bounds it too), and the
// deflections are cut near the peak, so that a car that has slid comes to rest without springing back.
//
// The aligning moment acts as far as the tyre rolls: not at standstill, wholly from low_speed on, with the other sign
// in reverse. The patch's twist w about the normal goes by the same equation, with half the patch's length a:
//   a dw/dt + |vx| w = a turn,
// and turns back by its stiffness times w, so that the torque of parking fades as the wheel begins to roll.
class Tyre {
 public:
  // The forces at the present deflections. Keeps the slips for slip() and slip_angle_tan().
  TyreForces Forces(const TyreSettings& tyre, const TyreMotion& motion, double load_N, double friction);
  // Advances the deflections with the motion at the end of the step (implicit in u and v). Without load they fade in 10
  // ms.
  void Advance(const TyreSettings& tyre, const TyreMotion& motion, double load_N, double friction, double dt_s);
  // The same to second order (trapezoidal rule), from the motion at the step's beginning to the one at its end.
  void Advance(const TyreSettings& tyre, const TyreMotion& before, const TyreMotion& after, double load_N,
               double friction, double dt_s);
  // The forces at that step's end: the deflections stay, slip() and slip_angle_tan() are those then.
  TyreForces ForcesAfter(const TyreSettings& tyre, const TyreMotion& before, const TyreMotion& after, double load_N,
                         double friction, double dt_s);
  // Deflections at which the tyre bears these forces steadily at standstill, as near as friction allows (inverse of the
  // pure formulas below the peaks).
  void SetToBear(const TyreSettings& tyre, const TyreForces& forces, double load_N, double friction,
                 double camber_rad = 0.0);
  // Deflections of steady rolling with this motion.
  void SetToRoll(const TyreSettings& tyre, const TyreMotion& motion, double load_N, double friction);
  // Deflections of steady rolling at vx_mps (not 0) that bear these forces, as near as friction allows. Returns how the
  // wheel must move for that.
  TyreMotion SetToRollAndBear(const TyreSettings& tyre, const TyreForces& forces, double vx_mps, double load_N,
                              double friction, double camber_rad = 0.0);
  // Without deflection.
  void Reset() { *this = Tyre(); }

  double slip() const { return slip_; }
  double slip_angle_tan() const { return slip_angle_tan_; }

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

 private:
  void FadeInAir(double dt_s);
  void CutNearThePeak(const TyreSettings& tyre, const TyreMotion& motion, double load_N, double friction);
  // `turned_rad` during the step, in which the wheel rolls `rolled_m`.
  void AdvanceTwist(const TyreSettings& tyre, double turned_rad, double rolled_m, double load_N, double friction);
  double TwistTorque(const TyreSettings& tyre, const TyreForces& forces, double load_N, double friction) const;

  double u_m_ = 0.0;
  double v_m_ = 0.0;
  double twist_rad_ = 0.0;
  double slip_ = 0.0;
  double slip_angle_tan_ = 0.0;
};

}  // namespace rodeira::dynamics
