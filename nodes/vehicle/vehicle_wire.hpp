#pragma once

#include <cstdint>

#include "common/vehicle/dynamics/controls.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"
#include "common/vehicle/dynamics/vehicle_state.hpp"
#include "idl/messages.hpp"

namespace rodeira::nodes {

vehicle::Controls FromWire(const msg::Controls& in);
// Pose, speeds, gear and engine of a published state: what a model needs to go on from it.
vehicle::VehicleState FromWire(const msg::VehicleState& in);
// Which lights shine (bits as in vehicle.idl) under these controls in this gear; indicators without their flashing.
std::uint32_t LightsOf(const msg::Controls& controls, int gear);
msg::VehicleState ToWire(const vehicle::VehicleState& state, const vehicle::VehicleDimensions& dimensions);

}  // namespace rodeira::nodes
