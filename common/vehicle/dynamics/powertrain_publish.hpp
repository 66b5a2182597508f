// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/vehicle/dynamics/powertrain.hpp"
#include "common/vehicle/dynamics/vehicle_state.hpp"

namespace rodeira::dynamics {

// What a published state says of engine, clutch, gear and fuel.
void PublishPowertrain(const Powertrain& powertrain, VehicleState& state);

}  // namespace rodeira::dynamics
