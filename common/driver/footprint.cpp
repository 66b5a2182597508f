#include "common/driver/footprint.hpp"

#include <cmath>

namespace rodeira::driver {

Footprint FootprintOf(std::uint32_t id, const vehicle::VehicleState& state, const vehicle::VehicleDimensions& dimensions) {
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

}  // namespace rodeira::driver
