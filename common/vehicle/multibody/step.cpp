// SPDX-License-Identifier: Apache-2.0
// One time step: Newton's method on the positions, then the projections.
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/base/assert.hpp"
#include "common/vehicle/multibody/system.hpp"

namespace rodeira::multibody {
namespace {

constexpr double kRounding = 5e-16;     // far from the world's origin a length is not known better
constexpr double kSettledShare = 0.01;  // a projection ends when its next turn would be this small against its first
constexpr double kNearer = 0.3;         // a turn that leaves more than this has got no nearer
constexpr double kDoubt = 1.05;         // a contraction that was not measured is trusted that much less a step
constexpr double kCarried = 0.1;  // of what a change may be, where its contraction was measured in an earlier step
constexpr double kLeast = 1e-6;   // and none below this, which would be rounding

}  // namespace

void Contraction::Learn(int turns, double changed, double changed_before) {
  if (turns > 1 && changed_before > 0.0)
    rate = std::clamp(changed / changed_before, kLeast, 1.0);
  else
    rate = std::min(1.0, kDoubt * rate);
}

void System::Foresee(double dt_s, std::span<double> q, std::span<double> qd) const {
  for (std::size_t i = 0; i < q_.size(); ++i) {
    q[i] = q_[i] + dt_s * (qd_[i] + 0.5 * dt_s * qdd_[i]);
    qd[i] = qd_[i] + dt_s * qdd_[i];
  }
}

// Where the accelerations lead that go on as they did over the last step.
void System::Predict(double dt_s) {
  const double ahead = earlier_s_ > 0.0 ? 0.25 * dt_s / earlier_s_ : 0.0;
  for (std::size_t i = 0; i < way_.size(); ++i)
    way_[i] = dt_s * (qd0_[i] + dt_s * (0.5 * qdd0_[i] + ahead * (qdd0_[i] - earlier_[i])));
  earlier_.swap(earlier0_);
  std::copy(qdd0_.begin(), qdd0_.end(), earlier_.begin());
  earlier0_s_ = earlier_s_;
  earlier_s_ = dt_s;
  newton0_ = newton_;
}

// Expects constraints evaluated; the matrix then holds what K and C the loads gave.
bool System::Factorise(double dt_s) {
  std::copy(constant_.begin(), constant_.end(), matrix_.values().begin());
  constraints_.AddRows(weight_, matrix_.values().data());
  SumForces(matrix_.values().data(), 0.25 * dt_s * dt_s, 0.5 * dt_s);
  return matrix_.Factorise();
}

StepReport System::Step(double dt_s) {
  RODEIRA_ASSERT(dt_s > 0.0);
  StepReport report;
  const double quarter = 0.25 * dt_s * dt_s;
  const double alpha = weight_ / quarter;
  const std::size_t size = q_.size();
  const double rounding_m = kRounding * FreeMaximum(q_.data());
  const double violation_m = settings_.violation_m + rounding_m;
  const double change_m = settings_.change_mps2 * quarter + rounding_m;
  std::copy(q_.begin(), q_.end(), q0_.begin());
  std::copy(qd_.begin(), qd_.end(), qd0_.begin());
  std::copy(qdd_.begin(), qdd_.end(), qdd0_.begin());
  std::copy(lambda_.begin(), lambda_.end(), lambda0_.begin());
  time0_s_ = time_s_;
  Predict(dt_s);
  time_s_ += dt_s;
  report.converged = false;
  double changed = 0.0;
  double changed_before = std::numeric_limits<double>::infinity();
  double violation_before = changed_before;
  for (int turn = 0; turn < settings_.most_iterations; ++turn) {
    // The way since the step's beginning is the unknown: no digits are lost to where in the world this happens.
    for (std::size_t i = 0; i < size; ++i) {
      q_[i] = q0_[i] + way_[i];
      qd_[i] = 2.0 / dt_s * way_[i] - qd0_[i];
      qdd_[i] = (way_[i] - dt_s * qd0_[i]) / quarter - qdd0_[i];
    }
    constraints_.Evaluate(q_.data(), time_s_);
    const auto values = constraints_.values();
    if (turn > 0) {
      for (std::size_t i = 0; i < lambda_.size(); ++i) lambda_[i] += alpha * values[i];
      const double violation = LargestOf(values);
      const bool nearer = changed < kNearer * changed_before || violation < kNearer * violation_before;
      const double next = newton_.Next(turn, changed, changed_before);
      if (turn == 2) newton_.Learn(turn, changed, changed_before);
      report.converged = (next <= (turn == 1 ? kCarried * change_m : change_m) && violation <= violation_m) ||
                         (!nearer && changed <= settings_.accepted_m && violation <= settings_.accepted_m);
      if (report.converged) {
        if (turn == 1) newton_.Learn(turn, changed, changed_before);
        break;
      }
      changed_before = changed;
      violation_before = violation;
    }
    if (turn == 0) moved_m_ = 2.0 * stale_m_;
    if (moved_m_ > stale_m_) {
      if (!Refresh(dt_s, report)) return report;
    } else {
      SumForces(nullptr, 0.0, 0.0);
    }
    std::fill(residual_.begin(), residual_.end(), 0.0);
    MultiplyMass(qdd_.data(), residual_.data());
    for (std::size_t i = 0; i < size; ++i) residual_[i] = quarter * (residual_[i] - forces_[i]);
    for (std::size_t i = 0; i < mu_.size(); ++i) mu_[i] = quarter * lambda_[i] + weight_ * values[i];
    constraints_.AddTransposed(mu_.data(), residual_.data());
    Mask(residual_.data());
    matrix_.Solve(residual_.data(), change_.data());
    for (std::size_t i = 0; i < size; ++i) way_[i] -= change_[i];
    changed = FreeMaximum(change_.data());
    moved_m_ += changed;
    ++report.iterations;
    if (!(changed < 1e6)) return report;
  }
  if (!report.converged) return report;
  if (moved_m_ > stale_m_ && !Refresh(dt_s, report)) {
    report.converged = false;
    return report;
  }
  report.converged = ProjectVelocities(report) && ProjectAccelerations(report);
  return report;
}

void System::Undo() {
  std::copy(q0_.begin(), q0_.end(), q_.begin());
  std::copy(qd0_.begin(), qd0_.end(), qd_.begin());
  std::copy(qdd0_.begin(), qdd0_.end(), qdd_.begin());
  std::copy(lambda0_.begin(), lambda0_.end(), lambda_.begin());
  std::copy(earlier0_.begin(), earlier0_.end(), earlier_.begin());
  time_s_ = time0_s_;
  earlier_s_ = earlier0_s_;
  newton_ = newton0_;
}

bool System::Refresh(double dt_s, StepReport& report) {
  ++report.factorisations;
  moved_m_ = 0.0;
  return Factorise(dt_s);
}

// The v nearest to the given one in the metric of M that fulfils Φq v + bias = 0 (bias_ holds it): M (v - v*) + Φqᵀ nu
// = 0 by augmented Lagrangian, so that the result does not depend on the matrix having been made at exactly these
// coordinates. nu_ holds nu then.
bool System::Project(std::vector<double>& v, double wanted, double accepted, StepReport& report) {
  std::copy(v.begin(), v.end(), way_.begin());
  std::fill(nu_.begin(), nu_.end(), 0.0);
  double before = std::numeric_limits<double>::infinity();
  double first = 0.0;
  double changed = 0.0;
  double changed_before = 0.0;
  for (int turn = 0;; ++turn) {
    constraints_.Multiply(v.data(), mu_.data());
    for (std::size_t i = 0; i < mu_.size(); ++i) mu_[i] += bias_[i];
    const double violation = LargestOf(mu_);
    const bool settled = turn == 0 || (turn > 1 && changed * changed <= kSettledShare * first * changed_before);
    const bool done =
        (violation <= wanted && settled) || (violation <= accepted && violation > kNearer * before && turn > 2);
    if (done) {
      for (std::size_t i = 0; turn > 0 && i < mu_.size(); ++i) nu_[i] += weight_ * mu_[i];
      return true;
    }
    if (turn == settings_.most_iterations || !std::isfinite(violation)) return false;
    before = violation;
    for (std::size_t i = 0; i < mu_.size(); ++i) {
      if (turn > 0) nu_[i] += weight_ * mu_[i];
      mu_[i] = nu_[i] + weight_ * mu_[i];
    }
    std::fill(residual_.begin(), residual_.end(), 0.0);
    if (turn > 0) {
      for (std::size_t i = 0; i < v.size(); ++i) change_[i] = v[i] - way_[i];
      MultiplyMass(change_.data(), residual_.data());
    }
    constraints_.AddTransposed(mu_.data(), residual_.data());
    Mask(residual_.data());
    matrix_.Solve(residual_.data(), change_.data());
    for (std::size_t i = 0; i < v.size(); ++i) v[i] -= change_[i];
    changed_before = changed;
    changed = FreeMaximum(change_.data());
    if (turn == 0) first = changed;
    ++report.projections;
  }
}

bool System::ProjectVelocities(StepReport& report) {
  std::fill(bias_.begin(), bias_.end(), 0.0);
  constraints_.AddTimeRate(time_s_, bias_.data());
  return Project(qd_, settings_.violation_mps, settings_.accepted_mps, report);
}

bool System::ProjectAccelerations(StepReport& report) {
  constraints_.Bias(q_.data(), qd_.data(), time_s_, bias_.data());
  const bool good = Project(qdd_, settings_.violation_mps2, std::numeric_limits<double>::max(), report);
  for (std::size_t i = 0; i < nu_.size(); ++i) reactions_[i] = lambda_[i] + nu_[i];
  return good;
}

// v -= A⁻¹ Φqᵀ α h²/4 mu.
void System::Correct(std::vector<double>& v) {
  for (double& each : mu_) each *= weight_;
  std::fill(residual_.begin(), residual_.end(), 0.0);
  constraints_.AddTransposed(mu_.data(), residual_.data());
  Mask(residual_.data());
  matrix_.Solve(residual_.data(), change_.data());
  for (std::size_t i = 0; i < v.size(); ++i) v[i] -= change_[i];
}

}  // namespace rodeira::multibody
