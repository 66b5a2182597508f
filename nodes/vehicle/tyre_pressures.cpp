// SPDX-License-Identifier: Apache-2.0
#include "nodes/vehicle/tyre_pressures.hpp"

#include <span>

namespace rodeira::nodes {

void TyrePressures::Change(const scenario::TyreChoice& tyre, double to_share) {
  to_[tyre.wheel] = to_share;
  left_s_[tyre.wheel] = tyre.over_s;
  if (tyre.over_s == 0.0) share_[tyre.wheel] = to_share;
  changed_ = true;
}

const std::array<double, dynamics::kWheels>& TyrePressures::Step(double dt_s) {
  for (std::size_t i = 0; i < dynamics::kWheels; ++i) {
    if (!(left_s_[i] > 0.0)) continue;
    if (left_s_[i] <= dt_s) {
      share_[i] = to_[i];
      left_s_[i] = 0.0;
      continue;
    }
    share_[i] += (to_[i] - share_[i]) * dt_s / left_s_[i];
    left_s_[i] -= dt_s;
  }
  return share_;
}

void TyrePressures::Save(base::StateWriter& writer) const {
  writer.Put("share", std::span<const double>(share_));
  writer.Put("to", std::span<const double>(to_));
  writer.Put("left_s", std::span<const double>(left_s_));
  writer.Put("changed", changed_);
}

void TyrePressures::Restore(base::StateReader& reader) {
  reader.Get("share", std::span<double>(share_));
  reader.Get("to", std::span<double>(to_));
  reader.Get("left_s", std::span<double>(left_s_));
  reader.Get("changed", changed_);
}

}  // namespace rodeira::nodes
