// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/multibody/load.hpp"

namespace rodeira::multibody {

void Load::AlongForm(const Form& form, const Vector3d& n, Triple* gradients) const {
  for (std::size_t k = 0; k < entities_.size(); ++k) {
    Vector3d g = Vector3d::Zero();
    for (const Term& term : form.terms) {
      if (term.entity == entities_[k]) g += Transposed(term, n);
    }
    g = g.cwiseProduct(free_[k]);
    gradients[k].v = {g.x(), g.y(), g.z(), 0.0};
  }
}

}  // namespace rodeira::multibody
