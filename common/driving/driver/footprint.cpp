// SPDX-License-Identifier: Apache-2.0
#include "common/driving/driver/footprint.hpp"

#include <cmath>

namespace rodeira::driver {

Footprint FootprintOf(std::uint32_t id, const dynamics::VehicleState& state,
                      const dynamics::VehicleDimensions& dimensions) {
  Footprint footprint;
  footprint.id = id;
  footprint.heading_rad = state.heading_rad();
  const double ahead = 0.5 * (dimensions.front_m - dimensions.rear_m);
  footprint.x_m = state.p_WB_W.x() + ahead * std::cos(footprint.heading_rad);
  footprint.y_m = state.p_WB_W.y() + ahead * std::sin(footprint.heading_rad);
  footprint.speed_mps = state.speed_mps();
  footprint.length_m = dimensions.front_m + dimensions.rear_m;
  footprint.width_m = dimensions.width_m;
  return footprint;
}

bool Overlap(const Footprint& a, const Footprint& b) {
  const double dx = b.x_m - a.x_m, dy = b.y_m - a.y_m, far = a.length_m + a.width_m + b.length_m + b.width_m;
  if (std::fabs(dx) > far || std::fabs(dy) > far) return false;
  const double ca = std::cos(a.heading_rad), sa = std::sin(a.heading_rad), cb = std::cos(b.heading_rad),
               sb = std::sin(b.heading_rad);
  const auto parted = [&](double x, double y) {
    const double reach_a = 0.5 * (a.length_m * std::fabs(ca * x + sa * y) + a.width_m * std::fabs(ca * y - sa * x));
    const double reach_b = 0.5 * (b.length_m * std::fabs(cb * x + sb * y) + b.width_m * std::fabs(cb * y - sb * x));
    return std::fabs(dx * x + dy * y) >= reach_a + reach_b;
  };
  return !parted(ca, sa) && !parted(-sa, ca) && !parted(cb, sb) && !parted(-sb, cb);
}

}  // namespace rodeira::driver
