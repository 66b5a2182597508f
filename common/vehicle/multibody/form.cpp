// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/multibody/form.hpp"

namespace rodeira::multibody {

Form Single(int entity) { return {.terms = {{entity, 1.0, 0.0}}}; }

Form Sum(const Form& first, const Form& second, double factor) {
  Form sum = first;
  for (const Term& term : second.terms) {
    bool found = false;
    for (Term& other : sum.terms) {
      if (other.entity != term.entity) continue;
      other.a += factor * term.a;
      other.b += factor * term.b;
      found = true;
    }
    if (!found) sum.terms.push_back({term.entity, factor * term.a, factor * term.b});
  }
  for (const auto& [body, term] : second.parts)
    sum.parts.push_back({body, {term.entity, factor * term.a, factor * term.b}});
  return sum;
}

Form TurnedAboutZ(const Form& form) {
  Form turned = form;
  for (Term& term : turned.terms) term = {term.entity, -term.b, term.a};
  for (Form::Part& part : turned.parts) part.term = {part.term.entity, -part.term.b, part.term.a};
  return turned;
}

Form OfBody(Form form, int body) {
  form.parts.clear();
  for (const Term& term : form.terms) form.parts.push_back({body, term});
  return form;
}

std::vector<int> EntitiesOf(const Form& form) {
  std::vector<int> entities;
  for (const Term& term : form.terms) entities.push_back(term.entity);
  return entities;
}

Vector3d Evaluate(const Form& form, const double* q) {
  Vector3d value = Vector3d::Zero();
  for (const Term& term : form.terms) value += ValueOf(term, q);
  return value;
}

void PushTerm(const Term& term, const Vector3d& force, double* out) {
  const Vector3d part = Transposed(term, force);
  for (int c = 0; c < 3; ++c) out[3 * term.entity + c] += part[c];
}

void Push(const Form& form, const Vector3d& force, double* out) {
  for (const Term& term : form.terms) PushTerm(term, force, out);
}

}  // namespace rodeira::multibody
