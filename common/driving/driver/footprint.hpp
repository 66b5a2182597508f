// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/vehicle/dynamics/vehicle_model.hpp"

namespace rodeira::driver {

// What others see of a car: a rectangle on the ground that moves along its heading.
struct Footprint {
  std::uint32_t id = 0;
  double x_m = 0.0;  // of the rectangle's middle
  double y_m = 0.0;
  double heading_rad = 0.0;  // from east, counter-clockwise
  double speed_mps = 0.0;    // along the heading, negative in reverse
  double length_m = 0.0;
  double width_m = 0.0;
};

// The rectangle of a car in W, from its bumpers, which need not lie evenly about B's origin.
Footprint FootprintOf(std::uint32_t id, const dynamics::VehicleState& state,
                      const dynamics::VehicleDimensions& dimensions);

// Whether two rectangles share ground: unless one of their four axes parts them.
bool Overlap(const Footprint& a, const Footprint& b);

}  // namespace rodeira::driver
