// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/core/base/state.hpp"
#include "common/vehicle/multibody/constraints.hpp"
#include "common/vehicle/multibody/drawing.hpp"

namespace rodeira::multibody {

// How exactly the equations are solved.
struct SystemSettings {
  // Penalty α h²/4 over the largest mass of a coordinate: from 2500 on it converges always; as it is a ratio, α follows
  // from step and mass.
  double penalty = 1e5;
  double change_mps2 = 1e-3;    // Newton ends when no coordinate is expected to change by more than this · h²/4 …
  double violation_m = 1e-10;   // … and no constraint is off by more
  double violation_mps = 1e-7;  // the projections end below these
  double violation_mps2 = 1e-4;
  // Where an iteration gets no nearer (at singular positions constraints become dependent, and their multipliers
  // converge slowly) this is still accepted; accelerations are accepted as they are.
  double accepted_m = 1e-8;
  double accepted_mps = 1e-6;
  int most_iterations = 30;
  // The matrix is made anew once coordinates have moved by this over the penalty, in shortest lengths of the mechanism:
  // with an older one the iterations do not contract well.
  double stale = 0.05;
};

// Largest size in a list, infinite where one is not finite.
double LargestOf(std::span<const double> values);

// What a step took.
struct StepReport {
  bool converged = true;
  int iterations = 0;   // of Newton
  int projections = 0;  // solutions for velocities and accelerations together
  int factorisations = 0;
};

// How much of the error a turn of Newton's method leaves: measured where two changes of one step are known, carried
// along to steps that have one as yet, where its product with the change says whether a second turn would bring
// anything. What is not measured anew is trusted less from step to step.
struct Contraction {
  double rate = 1.0;

  // Expected change of the next turn.
  double Next(int turns, double changed, double changed_before) const {
    if (turns > 1) return changed * std::min(1.0, changed / changed_before);
    return changed * rate;
  }
  // After a turn: what it changed, and what the one before did.
  void Learn(int turns, double changed, double changed_before);
};

// Accelerations of all coordinates and multipliers of all constraints that fulfil M qdd + Φqᵀ multipliers = Q.
struct Balance {
  std::vector<double> qdd;
  std::vector<double> multipliers;
};

// A mechanism in natural coordinates. Equations of motion by the index-3 augmented Lagrangian with projections of
// velocities and accelerations and the trapezoidal rule (Cuadrado, Cardenal, Morer, Bayo, Multibody System Dynamics 4
// (2000) 55-73):
//   M qdd + Φqᵀ(αΦ + λ) = Q,   λ += αΦ,   qd and qdd brought onto Φq qd + Φt = 0 and its derivative.
// Coordinates stand in triples, entity after entity; those that are fixed stand among them. M is constant, the matrix
// M + h/2 C + h²/4 (K + Φqᵀ α Φq) is made of 3 × 3 blocks with a pattern that is found once. After Make, no call
// allocates but Assemble, CheckIndependence and FindVelocities. Same calls, same bits.
class System {
 public:
  // Compiles the drawing; nothing is solved yet. Wrong input where nothing can move or nothing has mass.
  static base::Result<std::unique_ptr<System>> Make(const Drawing& drawing, const SystemSettings& settings = {});

  // The initial position problem: the nearest coordinates that fulfil all constraints. Wrong input, naming the
  // constraint with the largest violation, where none are found.
  base::Status Assemble();
  // Wrong input where a constraint follows from the others at this position (unless the drawing allows it), or where a
  // coordinate has neither mass nor constraint.
  base::Status CheckIndependence() const;
  // The smallest velocities that fulfil all constraints and what the drawing gives. Wrong input where there are none.
  base::Status FindVelocities();
  // Accelerations and multipliers that belong to position and velocity. False where the equations are singular.
  [[nodiscard]] bool FindAccelerations();
  // Assemble, CheckIndependence, FindVelocities and FindAccelerations, one after the other.
  base::Status Start();

  // Coordinates and velocities in dt_s if the accelerations stay as they are: what a load that must be set before a
  // step may act on. Three numbers an entity each.
  void Foresee(double dt_s, std::span<double> q, std::span<double> qd) const;

  // Advances by dt_s over 0. Where it does not converge the state is what the last iteration left.
  StepReport Step(double dt_s);

  // Back to where the last step began.
  void Undo();

  int entities() const { return static_cast<int>(drawing_.entities.size()); }
  int variables() const;           // coordinates that can move
  int degrees_of_freedom() const;  // at this position; allocates
  const Drawing& drawing() const { return drawing_; }
  const Constraints& constraints() const { return constraints_; }
  const BlockLdlt& matrix() const { return matrix_; }
  double time_s() const { return time_s_; }
  // Sets the time that laws of time see. Position and velocity stay as they are.
  void set_time_s(double time_s) { time_s_ = time_s; }
  std::span<double> q() { return q_; }
  std::span<const double> q() const { return q_; }
  std::span<double> qd() { return qd_; }
  std::span<const double> qd() const { return qd_; }
  std::span<const double> qdd() const { return qdd_; }
  Motion motion() const { return {q_.data(), qd_.data(), time_s_}; }
  Motion acceleration() const { return {q_.data(), qdd_.data(), time_s_}; }  // At: position, RateOf: acceleration
  Motion velocity_and_acceleration() const { return {qd_.data(), qdd_.data(), time_s_}; }
  // Forces (torques) of the constraints, in the constraints' order; positive pulls the row's value down. They belong to
  // qdd() as it has been projected: M qdd + Φqᵀ multipliers = Q. After Restore: from the next step on.
  std::span<const double> multipliers() const { return reactions_; }
  // Accelerations and multipliers that belong to position and velocity, solved anew; the state stays as it is.
  // multipliers() contains the weight of the constraints' violation, which grows with the rounding of positions far
  // from the origin. These have none of it. False where the equations are singular.
  [[nodiscard]] bool FindBalance(Balance& balance);
  // The kinetic energy of the velocities now, J.
  double KineticEnergy() const;
  // The potential energy of the weight and of the loads that have one, J.
  double PotentialEnergy() const;
  double Energy() const { return KineticEnergy() + PotentialEnergy(); }
  // Largest |Φ| and |Φq qd + Φt| now.
  double Violation();
  // In m/s or rad/s.
  double RateViolation();

  // Static equilibrium from the present position, velocities zero, by Newton's method in pseudo-time: a step of growing
  // length with damping. True where the residual acceleration is below `residual_mps2`; multipliers are then those of
  // rest.
  [[nodiscard]] bool FindEquilibrium(double residual_mps2, int most_iterations = 500);

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

 private:
  System(const Drawing& drawing, const SystemSettings& settings);
  base::Status Compile();
  base::Status CompileMass();
  void BindLoads();
  void SumForces(Block* matrix, double stiffness_factor, double damping_factor);
  [[nodiscard]] bool Factorise(double dt_s);
  void MultiplyMass(const double* v, double* out) const;
  void Mask(double* v) const;
  double FreeMaximum(const double* v) const;
  void Predict(double dt_s);
  bool Project(std::vector<double>& v, double wanted, double accepted, StepReport& report);
  bool ProjectVelocities(StepReport& report);
  bool ProjectAccelerations(StepReport& report);
  bool SolveAccelerations(std::vector<double>& qdd, std::vector<double>& lambda);
  void Correct(std::vector<double>& v);
  bool Refresh(double dt_s, StepReport& report);

  Drawing drawing_;
  SystemSettings settings_;
  std::vector<double> free_;        // 1 a coordinate that can move, 0 otherwise
  std::vector<int> free_entities_;  // with at least one such coordinate
  Constraints constraints_;
  BlockLdlt matrix_;
  std::vector<MassTerm> mass_;
  std::vector<Block> constant_;  // M, weighted ties, 1 for fixed coordinates
  double weight_ = 0.0;          // α h²/4
  double stale_m_ = 0.0;
  double moved_m_ = 0.0;  // since the last factorisation
  std::vector<double> weight_force_;

  double time_s_ = 0.0;
  std::vector<double> q_, qd_, qdd_, lambda_;
  // Accelerations at the beginning of the last step, and its length; 0 where there was none.
  std::vector<double> earlier_;
  double earlier_s_ = 0.0;
  Contraction newton_;
  double time0_s_ = 0.0;
  double earlier0_s_ = 0.0;
  Contraction newton0_;
  // Scratch, of no meaning between calls.
  std::vector<double> q0_, qd0_, qdd0_, lambda0_, earlier0_, way_, forces_, residual_, change_, mu_, nu_, bias_,
      reactions_;
};

}  // namespace rodeira::multibody
