// SPDX-License-Identifier: Apache-2.0
// Where a mechanism begins: position, velocity, acceleration, equilibrium.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "common/vehicle/multibody/system.hpp"

namespace rodeira::multibody {
namespace {

constexpr int kAssemblyTurns = 100;
constexpr double kAssembled_m = 1e-12;
constexpr double kNoAssembly_m = 1e-9;
constexpr double kDependent = 1e-8;  // what a gradient has beyond those before it, over its size
constexpr double kMassless = 1e-12;  // smallest over largest eigenvalue of M + Φqᵀ Φq

// Coordinates that can move, as columns of dense matrices (start only).
std::vector<int> Columns(const std::vector<double>& free) {
  std::vector<int> columns;
  for (std::size_t i = 0; i < free.size(); ++i) {
    if (free[i] != 0.0) columns.push_back(static_cast<int>(i));
  }
  return columns;
}

Eigen::MatrixXd Jacobian(const Constraints& constraints, const std::vector<int>& columns, std::size_t size) {
  Eigen::MatrixXd jacobian(constraints.count(), static_cast<Eigen::Index>(columns.size()));
  std::vector<double> mu(static_cast<std::size_t>(constraints.count()), 0.0);
  for (int row = 0; row < constraints.count(); ++row) {
    std::vector<double> gradient(size, 0.0);
    mu[static_cast<std::size_t>(row)] = 1.0;
    constraints.AddTransposed(mu.data(), gradient.data());
    mu[static_cast<std::size_t>(row)] = 0.0;
    for (std::size_t k = 0; k < columns.size(); ++k)
      jacobian(row, static_cast<Eigen::Index>(k)) = gradient[static_cast<std::size_t>(columns[k])];
  }
  return jacobian;
}

}  // namespace

base::Status System::Assemble() {
  const std::vector<int> columns = Columns(free_);
  const std::vector<double> drawn = q_;
  double violation = Violation();
  for (int turn = 0; turn < kAssemblyTurns && violation > kAssembled_m; ++turn) {
    const Eigen::MatrixXd jacobian = Jacobian(constraints_, columns, q_.size());
    const auto values = constraints_.values();
    const Eigen::VectorXd step = jacobian.completeOrthogonalDecomposition().solve(
        Eigen::Map<const Eigen::VectorXd>(values.data(), constraints_.count()));
    if (!step.allFinite()) break;
    // Shortened where the whole step would not help.
    const std::vector<double> before = q_;
    double share = 1.0;
    double next = violation;
    for (int half = 0; half < 12; ++half, share *= 0.5) {
      for (std::size_t k = 0; k < columns.size(); ++k) {
        const auto at = static_cast<std::size_t>(columns[k]);
        q_[at] = before[at] - share * step[static_cast<Eigen::Index>(k)];
      }
      next = Violation();
      if (next < violation) break;
    }
    if (!(next < violation)) {
      q_ = before;
      break;
    }
    violation = next;
  }
  violation = Violation();
  if (violation <= kNoAssembly_m) return {};
  int worst = 0;
  const auto values = constraints_.values();
  for (int i = 1; i < constraints_.count(); ++i) {
    if (!(std::fabs(values[static_cast<std::size_t>(i)]) <= std::fabs(values[static_cast<std::size_t>(worst)])))
      worst = i;
  }
  return base::WrongInput(
      "mechanism.cannot_be_assembled",
      fmt::format(
          "the mechanism cannot be assembled: at the nearest position found, '{}' is still off by {:.3g} (m or rad)",
          constraints_.name(worst), std::fabs(values[static_cast<std::size_t>(worst)])),
      constraints_.place(worst));
}

int System::degrees_of_freedom() const {
  Constraints constraints = constraints_;
  constraints.Evaluate(q_.data(), time_s_);
  const std::vector<int> columns = Columns(free_);
  auto decomposition = Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(Jacobian(constraints, columns, q_.size()));
  decomposition.setThreshold(kDependent);
  return static_cast<int>(columns.size()) - static_cast<int>(decomposition.rank());
}

base::Status System::CheckIndependence() const {
  Constraints constraints = constraints_;
  constraints.Evaluate(q_.data(), time_s_);
  const std::vector<int> columns = Columns(free_);
  const Eigen::MatrixXd jacobian = Jacobian(constraints, columns, q_.size());
  if (!drawing_.redundant) {
    // Gram and Schmidt in the constraints' order, so that the one that is named came later in the file.
    Eigen::MatrixXd basis(jacobian.cols(), std::min(jacobian.rows(), jacobian.cols()));
    Eigen::Index known = 0;
    for (int row = 0; row < constraints.count(); ++row) {
      Eigen::VectorXd rest = jacobian.row(row).transpose();
      const double size = rest.norm();
      const bool tie_of_fixed = row >= constraints.rows() && size == 0.0;  // a planar mechanism's z
      if (tie_of_fixed) continue;
      for (int twice = 0; twice < 2; ++twice)
        rest -= basis.leftCols(known) * (basis.leftCols(known).transpose() * rest);
      if (!(rest.norm() > kDependent * size)) {
        return base::WrongInput(
            "mechanism.redundant_constraint",
            fmt::format("constraint '{}' says nothing that the others do not say already at this position (it is "
                        "redundant, or the "
                        "position is singular); leave it out, move the position, or say 'redundant: true'",
                        constraints.name(row)),
            constraints.place(row));
      }
      basis.col(known++) = rest.normalized();
    }
  }
  Eigen::MatrixXd weighed = jacobian.transpose() * jacobian;
  double largest = 0.0;
  for (const MassTerm& term : mass_) largest = std::max(largest, std::fabs(term.a));
  std::vector<Eigen::Index> column(q_.size(), -1);
  for (std::size_t k = 0; k < columns.size(); ++k)
    column[static_cast<std::size_t>(columns[k])] = static_cast<Eigen::Index>(k);
  for (const MassTerm& term : mass_) {
    for (int c = 0; c < 3; ++c) {
      for (int d = 0; d < 2 || d == c; ++d) {
        const double value = c == d ? term.a : (c == 0 && d == 1 ? -term.b : (c == 1 && d == 0 ? term.b : 0.0));
        const Eigen::Index r = column[static_cast<std::size_t>(3 * term.row + c)];
        const Eigen::Index k = column[static_cast<std::size_t>(3 * term.column + d)];
        if (r < 0 || k < 0 || value == 0.0) continue;
        weighed(r, k) += value / largest;
        if (term.row != term.column) weighed(k, r) += value / largest;
      }
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(weighed);
  if (eigen.eigenvalues()[0] > kMassless * eigen.eigenvalues().tail(1)[0]) return {};
  Eigen::Index loose = 0;
  eigen.eigenvectors().col(0).cwiseAbs().maxCoeff(&loose);
  const EntityDrawing& entity =
      drawing_.entities[static_cast<std::size_t>(columns[static_cast<std::size_t>(loose)] / 3)];
  return base::WrongInput(
      "mechanism.no_mass",
      fmt::format("'{}' can move but has no mass: no body and no constraint gives it any", entity.name), entity.place);
}

base::Status System::FindVelocities() {
  (void)Violation();
  const std::vector<int> columns = Columns(free_);
  const Eigen::MatrixXd jacobian = Jacobian(constraints_, columns, q_.size());
  const auto given = static_cast<Eigen::Index>(drawing_.velocities.size());
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(jacobian.rows() + given, jacobian.cols());
  Eigen::VectorXd right = Eigen::VectorXd::Zero(system.rows());
  system.topRows(jacobian.rows()) = jacobian;
  std::vector<double> rate(lambda_.size(), 0.0);
  constraints_.AddTimeRate(time_s_, rate.data());
  for (std::size_t i = 0; i < rate.size(); ++i) right[static_cast<Eigen::Index>(i)] = -rate[i];
  for (Eigen::Index i = 0; i < given; ++i) {
    const GivenVelocity& velocity = drawing_.velocities[static_cast<std::size_t>(i)];
    const auto found = std::find(columns.begin(), columns.end(), 3 * velocity.entity + velocity.component);
    if (found == columns.end()) {
      if (velocity.rate == 0.0) continue;
      return base::WrongInput("mechanism.cannot_be_assembled",
                              fmt::format("'{}' is given a velocity but cannot move that way",
                                          drawing_.entities[static_cast<std::size_t>(velocity.entity)].name),
                              velocity.place);
    }
    system(jacobian.rows() + i, found - columns.begin()) = 1.0;
    right[jacobian.rows() + i] = velocity.rate;
  }
  const Eigen::VectorXd solution = system.completeOrthogonalDecomposition().solve(right);
  const Eigen::VectorXd off = system * solution - right;
  Eigen::Index worst = 0;
  if (off.size() > 0 && off.cwiseAbs().maxCoeff(&worst) > 1e-9 * (1.0 + right.cwiseAbs().maxCoeff())) {
    const bool of_given = worst >= jacobian.rows();
    return base::WrongInput("mechanism.cannot_be_assembled", "the initial velocities do not fit the constraints",
                            of_given ? drawing_.velocities[static_cast<std::size_t>(worst - jacobian.rows())].place
                                     : constraints_.place(static_cast<int>(worst)));
  }
  for (std::size_t k = 0; k < columns.size(); ++k)
    qd_[static_cast<std::size_t>(columns[k])] = solution[static_cast<Eigen::Index>(k)];
  return {};
}

bool System::SolveAccelerations(std::vector<double>& qdd, std::vector<double>& lambda) {
  constexpr int kMaxTurns = 50;
  constraints_.Evaluate(q_.data(), time_s_);
  std::copy(constant_.begin(), constant_.end(), matrix_.values().begin());
  constraints_.AddRows(weight_, matrix_.values().data());
  if (!matrix_.Factorise()) return false;
  SumForces(nullptr, 0.0, 0.0);
  constraints_.Bias(q_.data(), qd_.data(), time_s_, bias_.data());
  qdd.assign(q_.size(), 0.0);
  lambda.assign(mu_.size(), 0.0);
  double before = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < kMaxTurns; ++turn) {
    // M qdd + Φqᵀ λ = Q with λ += w (Φq qdd + bias): the remainder goes through the same matrix.
    constraints_.Multiply(qdd.data(), mu_.data());
    double most = 0.0;
    for (std::size_t i = 0; i < mu_.size(); ++i) {
      mu_[i] += bias_[i];
      most = std::max(most, std::fabs(mu_[i]));
    }
    for (std::size_t i = 0; i < mu_.size(); ++i) {
      if (turn > 0) lambda[i] += weight_ * mu_[i];
      mu_[i] = lambda[i] + weight_ * mu_[i];
    }
    std::fill(residual_.begin(), residual_.end(), 0.0);
    MultiplyMass(qdd.data(), residual_.data());
    for (std::size_t i = 0; i < residual_.size(); ++i) residual_[i] -= forces_[i];
    constraints_.AddTransposed(mu_.data(), residual_.data());
    Mask(residual_.data());
    matrix_.Solve(residual_.data(), change_.data());
    for (std::size_t i = 0; i < qdd.size(); ++i) qdd[i] -= change_[i];
    const double changed = FreeMaximum(change_.data());
    if (!std::isfinite(changed)) return false;
    if (turn > 2 && changed >= before && most < 1e-6 * (1.0 + FreeMaximum(qdd.data()))) break;  // as good as it gets
    if (turn > 0 && changed == 0.0) break;
    before = changed;
  }
  return true;
}

bool System::FindAccelerations() {
  earlier_s_ = 0.0;
  newton_ = {};
  if (!SolveAccelerations(qdd_, lambda_)) return false;
  reactions_ = lambda_;
  return true;
}

bool System::FindBalance(Balance& balance) { return SolveAccelerations(balance.qdd, balance.multipliers); }

base::Status System::Start() {
  if (auto status = Assemble(); !status) return status;
  if (auto status = CheckIndependence(); !status) return status;
  if (auto status = FindVelocities(); !status) return status;
  if (!FindAccelerations())
    return base::WrongInput("mechanism.singular", "the mechanism's equations are singular at the initial position",
                            drawing_.place);
  return {};
}

// Backward Euler in pseudo-time: (M/τ² + K + Φqᵀ w Φq) Δ = -(R), velocities zero; τ grows while the residual falls,
// until the mass no longer matters.
bool System::FindEquilibrium(double residual_mps2, int most_iterations) {
  std::fill(qd_.begin(), qd_.end(), 0.0);
  double pseudo_s = 0.01;
  double before = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < most_iterations; ++turn) {
    if (!FindAccelerations()) return false;
    const double residual = FreeMaximum(qdd_.data());
    if (residual <= residual_mps2 && Violation() <= settings_.violation_m) return true;
    if (!std::isfinite(residual)) return false;
    pseudo_s = residual < before ? std::min(1e3, 1.5 * pseudo_s) : std::max(1e-3, 0.3 * pseudo_s);
    before = residual;
    // The step that M qdd would take: Newton's right side is M qdd, since the multipliers are those of this position.
    std::fill(residual_.begin(), residual_.end(), 0.0);
    MultiplyMass(qdd_.data(), residual_.data());
    constraints_.Evaluate(q_.data(), time_s_);
    std::copy(constant_.begin(), constant_.end(), matrix_.values().begin());
    constraints_.AddRows(weight_, matrix_.values().data());
    SumForces(matrix_.values().data(), pseudo_s * pseudo_s, 0.0);
    if (!matrix_.Factorise()) return false;
    for (double& each : residual_) each *= pseudo_s * pseudo_s;
    Mask(residual_.data());
    matrix_.Solve(residual_.data(), change_.data());
    const double largest = FreeMaximum(change_.data());
    const double share = largest > 0.05 ? 0.05 / largest : 1.0;
    for (std::size_t i = 0; i < q_.size(); ++i) q_[i] += share * change_[i];
    // Back onto the constraints, in the metric of a matrix made where it is: an old one pushes along what is free.
    for (int again = 0; again < 10 && Violation() > settings_.violation_m; ++again) {
      std::copy(constant_.begin(), constant_.end(), matrix_.values().begin());
      constraints_.AddRows(weight_, matrix_.values().data());
      if (!matrix_.Factorise()) return false;
      std::copy(constraints_.values().begin(), constraints_.values().end(), mu_.begin());
      Correct(q_);
    }
  }
  return false;
}

}  // namespace rodeira::multibody
