// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/vehicle/multibody/body.hpp"
#include "common/vehicle/multibody/load.hpp"

namespace rodeira::multibody {

// An elastic joint's stiffness and damping.
struct BushingSettings {
  Vector3d stiffness_Npm = Vector3d::Zero();  // along the first body's axes as drawn
  Vector3d damping_Nspm = Vector3d::Zero();
  double turn_Nmprad = 0.0;  // against relative rotation, the same about every axis
  double turn_Nmsprad = 0.0;
};

// An elastic joint between two bodies: forces along the first body's axes from the displacement of two points that
// coincide as drawn, and a torque against relative rotation (½ k Σ eᵢ × e'ᵢ: linear for small turns). Or one between a
// body and a point, of a rod or a plate say: forces alone, from the point's way since it was drawn.
class Bushing final : public Load {
 public:
  Bushing(const Frame& first, const Frame& second, const Vector3d& drawn, const BushingSettings& settings);
  Bushing(const Frame& first, const Form& point, const Vector3d& drawn, const BushingSettings& settings);
  std::vector<int> Stiffens() const override;
  void Add(const Motion& motion, Sink& sink) const override;
  double Energy(const Motion& motion) const override;
  double Force(const Motion& motion) const override;

 private:
  bool turns() const { return settings_.turn_Nmprad != 0.0 || settings_.turn_Nmsprad != 0.0; }
  Vector3d ForceOn(const Motion& motion) const;
  Vector3d TorqueOn(const Motion& motion) const;

  Frame first_, second_;  // without a second body the latter's forms are empty
  Form at_first_, at_second_;
  Form gap_;
  BushingSettings settings_;
};

}  // namespace rodeira::multibody
