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

// The form over doubled coordinates: the body's parts in the first half, the rest in the second.
Form Split(const Form& form, int body, int entities) {
  Form split;
  for (Term rest : form.terms) {
    for (const Form::Part& part : form.parts) {
      if (part.body != body || part.term.entity != rest.entity) continue;
      split = Sum(split, Form{{part.term}});
      rest.a -= part.term.a;
      rest.b -= part.term.b;
    }
    rest.entity += entities;
    if (rest.a != 0.0 || rest.b != 0.0) split.terms.push_back(rest);
  }
  return split;
}

bool HasPart(const std::vector<Form::Part>& parts, int body) {
  return std::any_of(parts.begin(), parts.end(), [body](const Form::Part& part) { return part.body == body; });
}

}  // namespace

base::Result<JointForce> JointForce::Make(const System& system, int body, int point, SharedDistance shared) {
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
  force.body_ = body;
  force.point_ = point;
  force.mass_ = parts.mass;
  force.centre_ = parts.centre;
  force.mass_kg_ = parts.mass_kg;
  for (const RowDrawing& row : parts.rows) force.rows_.emplace_back(Row(row, all_free), Find(system, row.name));
  for (const Tie& tie : parts.ties) force.ties_.emplace_back(tie, Find(system, tie.name));
  const auto unknown = [](const auto& each) { return each.second < 0; };
  if (shared == SharedDistance::kOfTheEarlierBody) {
    std::erase_if(force.rows_, unknown);
    std::erase_if(force.ties_, unknown);
  }
  if (std::any_of(force.rows_.begin(), force.rows_.end(), unknown) ||
      std::any_of(force.ties_.begin(), force.ties_.end(), unknown)) {
    return base::WrongInput(
        "mechanism.forces_not_separable",
        fmt::format(
            "body '{}' is kept rigid by another body that has its points too: their forces cannot be told apart",
            name));
  }
  const std::vector<double> both_free(2 * system.q().size(), 1.0);
  for (const RowDrawing& row : drawing.rows) {
    const int index = Find(system, row.name);
    if (index < 0) continue;  // says nothing, or what another row says
    if (row.kind == RowKind::kSum) {
      Vector3d pull = Vector3d::Zero();
      for (const Form::Part& part : row.sum_parts) {
        if (part.body == body && part.term.entity == point) pull += Transposed(part.term, row.sum_axis);
      }
      if (!pull.isZero()) force.constant_.emplace_back(pull, index);
    } else if (HasPart(row.u.parts, body) || HasPart(row.v.parts, body) || HasPart(row.w.parts, body)) {
      RowDrawing split = row;
      for (Form* form : {&split.u, &split.v, &split.w}) *form = Split(*form, body, system.entities());
      force.beside_.emplace_back(Row(split, both_free), index);
    }
  }
  return force;
}

Vector3d JointForce::Now(const System& system) const { return Total(system, system.qdd(), system.multipliers()); }

Vector3d JointForce::In(const System& system, const Balance& balance) const {
  return Total(system, balance.qdd, balance.multipliers);
}

Vector3d JointForce::Total(const System& system, std::span<const double> qdd,
                           std::span<const double> multipliers) const {
  const auto of = [qdd](int entity) { return Vector3d(Eigen::Map<const Vector3d>(qdd.data() + 3 * entity)); };
  Vector3d force = Vector3d::Zero();
  for (const MassTerm& term : mass_) {
    if (term.row == point_) force += term.a * of(term.column) + term.b * AboutZ(of(term.column));
    if (term.column == point_ && term.row != point_) force += term.a * of(term.row) - term.b * AboutZ(of(term.row));
  }
  for (const Term& term : centre_.terms) {
    if (term.entity == point_) force -= Transposed(term, mass_kg_ * system.drawing().gravity_mps2);
  }
  std::vector<double> loads(system.q().size(), 0.0);
  Sink sink = Sink::OfBody(body_, loads.data());
  for (const NamedLoad& named : system.drawing().loads) named.load->Add(system.motion(), sink);
  force -= Vector3d(Eigen::Map<const Vector3d>(loads.data() + 3 * point_));
  std::vector<Triple> gradients;
  const auto pull = [&](const Row& row, const double* q, int index) {
    gradients.assign(row.entities().size(), Triple{});
    (void)row.Evaluate(q, system.time_s(), gradients.data());
    for (std::size_t k = 0; k < gradients.size(); ++k) {
      const auto& g = gradients[k].v;
      if (row.entities()[k] == point_)
        force += multipliers[static_cast<std::size_t>(index)] * Vector3d(g[0], g[1], g[2]);
    }
  };
  for (const auto& [row, index] : rows_) pull(row, system.q().data(), index);
  std::vector<double> both(system.q().begin(), system.q().end());
  both.insert(both.end(), system.q().begin(), system.q().end());
  for (const auto& [row, index] : beside_) pull(row, both.data(), index);
  for (const auto& [by, index] : constant_) force += multipliers[static_cast<std::size_t>(index)] * by;
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
