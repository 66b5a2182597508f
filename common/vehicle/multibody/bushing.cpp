// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/multibody/bushing.hpp"

#include <algorithm>
#include <array>

#include "common/core/base/assert.hpp"

namespace rodeira::multibody {

Bushing::Bushing(const Frame& first, const Frame& second, const Vector3d& drawn, const BushingSettings& settings)
    : first_(first),
      second_(second),
      at_first_(first.PointAt(drawn)),
      at_second_(second.PointAt(drawn)),
      gap_(Sum(at_second_, at_first_, -1.0)),
      settings_(settings) {}

Bushing::Bushing(const Frame& first, const Form& point, const Vector3d& drawn, const BushingSettings& settings)
    : first_(first),
      at_first_(first.PointAt(drawn)),
      at_second_(point),
      gap_(Sum(at_second_, at_first_, -1.0)),
      settings_(settings) {
  RODEIRA_ASSERT(settings.turn_Nmprad == 0.0 && settings.turn_Nmsprad == 0.0);
}

std::vector<int> Bushing::Stiffens() const {
  std::vector<int> entities = EntitiesOf(gap_);
  for (const Frame* frame : {&first_, &second_}) {
    for (const Form& axis : frame->axes) {
      for (const Term& term : axis.terms) entities.push_back(term.entity);
    }
  }
  std::sort(entities.begin(), entities.end());
  entities.erase(std::unique(entities.begin(), entities.end()), entities.end());
  return entities;
}

// On the second body.
Vector3d Bushing::ForceOn(const Motion& motion) const {
  const Vector3d gap = Evaluate(gap_, motion.q);
  const Vector3d rate = Evaluate(gap_, motion.qd);
  Vector3d force = Vector3d::Zero();
  for (int c = 0; c < 3; ++c) {
    const Vector3d e = Evaluate(first_.axes[static_cast<std::size_t>(c)], motion.q);
    const Vector3d ed = Evaluate(first_.axes[static_cast<std::size_t>(c)], motion.qd);
    force -= (settings_.stiffness_Npm[c] * e.dot(gap) + settings_.damping_Nspm[c] * (e.dot(rate) + ed.dot(gap))) * e;
  }
  return force;
}

Vector3d Bushing::TorqueOn(const Motion& motion) const {
  if (!turns()) return Vector3d::Zero();
  Vector3d turned = Vector3d::Zero();  // of the second against the first, for small turns
  Vector3d rate = Vector3d::Zero();
  for (std::size_t c = 0; c < 3; ++c) {
    const Vector3d e1 = Evaluate(first_.axes[c], motion.q), e2 = Evaluate(second_.axes[c], motion.q);
    const Vector3d d1 = Evaluate(first_.axes[c], motion.qd), d2 = Evaluate(second_.axes[c], motion.qd);
    turned += 0.5 * e1.cross(e2);
    rate += 0.5 * (e2.cross(d2) - e1.cross(d1));
  }
  return -settings_.turn_Nmprad * turned - settings_.turn_Nmsprad * rate;
}

void Bushing::Add(const Motion& motion, Sink& sink) const {
  const Vector3d force = ForceOn(motion);
  sink.Push(at_second_, force);
  // The reaction acts on the first body where the second one's point now is, so that no moment is made from nothing.
  const Vector3d arm = Evaluate(gap_, motion.q);
  const Vector3d torque = TorqueOn(motion);
  sink.Push(at_first_, -force);
  sink.PushTorque(first_, -arm.cross(force) - torque, motion.q);
  if (turns()) sink.PushTorque(second_, torque, motion.q);
  if (!sink.wants_matrix()) return;
  std::array<Triple, kMaxLoadEntities> gradients;
  for (int c = 0; c < 3; ++c) {
    const Vector3d e = Evaluate(first_.axes[static_cast<std::size_t>(c)], motion.q);
    AlongForm(gap_, e, gradients.data());
    sink.Stiffen(pairs_, gradients.data(), settings_.stiffness_Npm[c], settings_.damping_Nspm[c]);
    if (!turns()) continue;
    // Gradient of the relative turn about the world's axis c.
    for (std::size_t k = 0; k < entities_.size(); ++k) gradients[k] = {};
    for (std::size_t a = 0; a < 3; ++a) {
      for (const auto& [frame, sign] : {std::pair(&second_, 0.5), std::pair(&first_, -0.5)}) {
        const Vector3d axis = Evaluate(frame->axes[a], motion.q);
        const Vector3d pull = sign * Vector3d::Unit(c).cross(axis);
        for (const Term& term : frame->axes[a].terms) {
          for (std::size_t k = 0; k < entities_.size(); ++k) {
            if (entities_[k] != term.entity) continue;
            const Vector3d g = Transposed(term, pull).cwiseProduct(free_[k]);
            for (int i = 0; i < 3; ++i) gradients[k].v[static_cast<std::size_t>(i)] += g[i];
          }
        }
      }
    }
    sink.Stiffen(pairs_, gradients.data(), settings_.turn_Nmprad, settings_.turn_Nmsprad);
  }
}

double Bushing::Energy(const Motion& motion) const {
  const Vector3d gap = Evaluate(gap_, motion.q);
  double energy = 0.0;
  double aligned = 0.0;  // cosines of the turn, where it is resisted
  for (std::size_t c = 0; c < 3; ++c) {
    const Vector3d e = Evaluate(first_.axes[c], motion.q);
    energy += 0.5 * settings_.stiffness_Npm[static_cast<int>(c)] * e.dot(gap) * e.dot(gap);
    if (turns()) aligned += e.dot(Evaluate(second_.axes[c], motion.q));
  }
  return energy + 0.5 * settings_.turn_Nmprad * (3.0 - aligned);
}

double Bushing::Force(const Motion& motion) const { return ForceOn(motion).norm(); }

}  // namespace rodeira::multibody
