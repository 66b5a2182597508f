// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/vehicle/dynamics/controls.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"
#include "common/vehicle/dynamics/vehicle_state.hpp"
#include "idl/messages.hpp"

namespace rodeira::nodes {

dynamics::Controls FromWire(const msg::Controls& in);
// Pose, speeds, gear and engine of a published state: what a model needs to go on from it.
dynamics::VehicleState FromWire(const msg::VehicleState& in);
// Which lights shine (bits as in vehicle.idl) under these controls in this gear; indicators without their flashing.
std::uint32_t LightsOf(const msg::Controls& controls, int gear);
msg::VehicleState ToWire(const dynamics::VehicleState& state, const dynamics::VehicleDimensions& dimensions);

}  // namespace rodeira::nodes
