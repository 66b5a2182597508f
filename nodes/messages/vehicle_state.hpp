// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/vehicle/dynamics/vehicle_model.hpp"
#include "common/vehicle/dynamics/vehicle_state.hpp"
#include "idl/messages.hpp"

namespace rodeira::nodes {

// Pose, motion, steering wheel, engine speed, gear and fuel. Accelerations are rounded (ToMessage); all else that the
// message holds is left out.
dynamics::VehicleState FromMessage(const msg::VehicleState& in);
// What an instrument reads is rounded to 16 significant bits; pose, speeds and what a model needs to go on are not.
msg::VehicleState ToMessage(const dynamics::VehicleState& state, const dynamics::VehicleDimensions& dimensions);
// Which lamps are on (bits as in vehicle.idl) with these controls in this gear; indicators without their flashing.
std::uint32_t LightsOf(const msg::Controls& controls, int gear);

}  // namespace rodeira::nodes
