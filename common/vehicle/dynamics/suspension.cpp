// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/suspension.hpp"

#include <algorithm>

namespace rodeira::dynamics {

// Balance along the strut, with travel d, damping c (0 when static), lean the cosine between strut and normal:
//   F0 + k d + k_b (d - d_other) + c (d - d_before) = lean · k_t · max(0, gap - lean · d)
void Corner::Bear(const SuspensionSettings& suspension, const CornerInput& input, double c, double before_m) {
  const double pull = c * before_m + suspension.anti_roll_Npm * input.other_travel_m - input.static_load_N;
  const double soft = suspension.spring_Npm + suspension.anti_roll_Npm + c;
  const double touching = input.lean * input.lean * input.tyre_Npm;
  double travel = (pull + input.lean * input.tyre_Npm * input.free_gap_m) / (soft + touching);
  if (input.free_gap_m - input.lean * travel < 0.0) travel = pull / soft;  // in the air: the spring extends alone
  travel_m_ = std::clamp(travel, -suspension.rebound_m, suspension.bump_m);
  const double deflection = std::clamp(input.free_gap_m - input.lean * travel_m_, 0.0, input.bottom_m);
  load_N_ = input.tyre_Npm * deflection;
  suspension_N_ = load_N_ * input.lean;
  damper_N_ = c * (travel_m_ - before_m);
}

void Corner::Step(const SuspensionSettings& suspension, const CornerInput& input, double dt_s) {
  Bear(suspension, input, suspension.damper_Nspm / dt_s, travel_m_);
}

void Corner::Settle(const SuspensionSettings& suspension, const CornerInput& input) {
  Bear(suspension, input, 0.0, 0.0);
}

void Corner::Save(base::StateWriter& writer) const {
  writer.Put("travel_m", travel_m_);
  writer.Put("load_N", load_N_);
  writer.Put("suspension_N", suspension_N_);
  writer.Put("damper_N", damper_N_);
}

void Corner::Restore(base::StateReader& reader) {
  reader.Get("travel_m", travel_m_);
  reader.Get("load_N", load_N_);
  reader.Get("suspension_N", suspension_N_);
  reader.Get("damper_N", damper_N_);
}

}  // namespace rodeira::dynamics
