// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "common/core/base/state.hpp"
#include "common/driving/scenario/event.hpp"
#include "common/vehicle/dynamics/vehicle_state.hpp"

namespace rodeira::nodes {

// The pressures of a car's tyres, as shares of those at the start; each changes evenly in the time that its event says.
class TyrePressures {
 public:
  // From what it is now.
  void Change(const scenario::TyreChoice& tyre, double to_share);
  // At the end of the step.
  const std::array<double, dynamics::kWheels>& Step(double dt_s);
  const std::array<double, dynamics::kWheels>& now() const { return share_; }
  // Whether one has ever changed.
  bool changed() const { return changed_; }

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

 private:
  std::array<double, dynamics::kWheels> share_{1.0, 1.0, 1.0, 1.0};
  std::array<double, dynamics::kWheels> to_{1.0, 1.0, 1.0, 1.0};
  std::array<double, dynamics::kWheels> left_s_{};
  bool changed_ = false;
};

}  // namespace rodeira::nodes
