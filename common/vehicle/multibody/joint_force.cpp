// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/multibody/joint_force.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rodeira::multibody {
namespace {

// Of the constraint with this name; -1: there is none.
int Find(const System& system, const std::string& name) {
  for (int i = 0; i < system.constraints().count(); ++i) {
    if (system.constraints().name(i) == name) return i;
  }
  return -1;
}

}  // namespace

base::Result<JointForce> JointForce::Make(const System& system, int body, int point) {
  const Drawing& drawing = system.drawing();
  const BodyParts& parts = drawing.bodies[static_cast<std::size_t>(body)];
  const std::string& name = drawing.body_names[static_cast<std::size_t>(body)];
  if (std::find(parts.entities.begin(), parts.entities.end(), point) == parts.entities.end()) {
    return base::WrongInput(
        "mechanism.wrong_body",
        fmt::format("'{}' is no point of body '{}'", drawing.entities[static_cast<std::size_t>(point)].name, name));
  }
  const std::vector<double> all_free(system.q().size(), 1.0);  // a fixed point too is pulled at
  JointForce force;
  force.point_ = point;
  force.mass_ = parts.mass;
  force.centre_ = parts.centre;
  force.mass_kg_ = parts.mass_kg;
  for (const RowDrawing& row : parts.rows) force.rows_.emplace_back(Row(row, all_free), Find(system, row.name));
  for (const Tie& tie : parts.ties) force.ties_.emplace_back(tie, Find(system, tie.name));
  const auto unknown = [](const auto& each) { return each.second < 0; };
  if (std::any_of(force.rows_.begin(), force.rows_.end(), unknown) ||
      std::any_of(force.ties_.begin(), force.ties_.end(), unknown)) {
    return base::WrongInput(
        "mechanism.forces_not_separable",
        fmt::format(
            "body '{}' is kept rigid by another body that has its points too: their forces cannot be told apart",
            name));
  }
  return force;
}

Vector3d JointForce::Now(const System& system) const {
  const double* qdd = system.qdd().data();
  const auto of = [qdd](int entity) { return Vector3d(Eigen::Map<const Vector3d>(qdd + 3 * entity)); };
  Vector3d force = Vector3d::Zero();
  for (const MassTerm& term : mass_) {
    if (term.row == point_) force += term.a * of(term.column) + term.b * AboutZ(of(term.column));
    if (term.column == point_ && term.row != point_) force += term.a * of(term.row) - term.b * AboutZ(of(term.row));
  }
  for (const Term& term : centre_.terms) {
    if (term.entity == point_) force -= Transposed(term, mass_kg_ * system.drawing().gravity_mps2);
  }
  const auto multipliers = system.multipliers();
  std::vector<Triple> gradients;
  for (const auto& [row, index] : rows_) {
    gradients.assign(row.entities().size(), Triple{});
    (void)row.Evaluate(system.q().data(), system.time_s(), gradients.data());
    for (std::size_t k = 0; k < gradients.size(); ++k) {
      const auto& g = gradients[k].v;
      if (row.entities()[k] == point_)
        force += multipliers[static_cast<std::size_t>(index)] * Vector3d(g[0], g[1], g[2]);
    }
  }
  for (const auto& [tie, index] : ties_) {
    const auto first = static_cast<std::size_t>(index);
    for (const Term& term : tie.terms) {
      if (term.entity == point_)
        force += Transposed(term, Vector3d(multipliers[first], multipliers[first + 1], multipliers[first + 2]));
    }
  }
  return force;
}

}  // namespace rodeira::multibody
