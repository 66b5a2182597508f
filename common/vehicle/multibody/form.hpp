// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace rodeira::multibody {

using Eigen::Vector3d;

// One summand of a form: a e + b (z × e), where e is the entity's triple of coordinates. b is 0 except on planar
// bodies; their second axis is the first one turned.
struct Term {
  int entity = 0;
  double a = 0.0;
  double b = 0.0;
};

// A point or a direction as a linear function of the coordinates: the sum of its terms. In natural coordinates
// everything that is fixed to a rigid body is one, which is why mass matrices are constant.
struct Form {
  std::vector<Term> terms;
  // Of the terms those that belong to a body's material points or directions beside its own points: a force at the form
  // acts on that body, at none of its points. Only joint forces ask for them.
  struct Part {
    int body = 0;
    Term term;
  };
  std::vector<Part> parts = {};
};

inline Vector3d AboutZ(const Vector3d& v) { return {-v.y(), v.x(), 0.0}; }  // z × v

// The entity itself.
Form Single(int entity);
// first + factor second; terms of the same entity are added together.
Form Sum(const Form& first, const Form& second, double factor = 1.0);
// Turned by 90 degrees about z (planar mechanisms).
Form TurnedAboutZ(const Form& form);

// The same form, all of it a part of the body.
Form OfBody(Form form, int body);

// In the order of the terms.
std::vector<int> EntitiesOf(const Form& form);

// Value with coordinates (or velocities) in triples, entity after entity.
Vector3d Evaluate(const Form& form, const double* q);
// Adds what a force (or gradient) at the form means for each entity: (a + b z×)ᵀ f.
void PushTerm(const Term& term, const Vector3d& force, double* out);
void Push(const Form& form, const Vector3d& force, double* out);

// The term's value with coordinates in triples.
inline Vector3d ValueOf(const Term& term, const double* q) {
  const Vector3d e(q[3 * term.entity], q[3 * term.entity + 1], q[3 * term.entity + 2]);
  return term.b == 0.0 ? Vector3d(term.a * e) : Vector3d(term.a * e + term.b * AboutZ(e));
}
// (a + b z×)ᵀ f.
inline Vector3d Transposed(const Term& term, const Vector3d& f) {
  return term.b == 0.0 ? Vector3d(term.a * f) : Vector3d(term.a * f - term.b * AboutZ(f));
}

}  // namespace rodeira::multibody
