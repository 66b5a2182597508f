// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "common/traffic/demand/vehicle_mix.hpp"
#include "common/traffic/state/leaving.hpp"
#include "common/world/network/lights.hpp"

// The words of the tables and of the files for SUMO.
namespace rodeira::traffic {

const char* NameOf(VehicleKind kind);             // car, van, lorry, bus
const char* NameOf(network::LightColour colour);  // red, red-amber, green, amber
const char* NameOf(LeaveReason reason);           // route end, network end, route missed, lane end, removed
// Of the bits of TrafficModel::LightsOf: "brake", "left", "right", joined by '+'; empty where none is on.
std::string NameOfLamps(std::uint32_t bits);

}  // namespace rodeira::traffic
