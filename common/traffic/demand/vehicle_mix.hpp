// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/core/config/config.hpp"

namespace rodeira::traffic {

// As in traffic.idl.
enum class VehicleKind : std::uint32_t { kCar = 0, kVan = 1, kLorry = 2, kBus = 3 };

// How many of each kind there are among all; shares with the sum 1.
struct VehicleMix {
  std::array<double, 4> shares{0.8, 0.2, 0.0, 0.0};  // by VehicleKind
};

// A list of names of kinds.
std::vector<VehicleKind> ReadKinds(const config::List& list);

// Reads `car`, `van`, `lorry`, `bus`: weights of any size, 0 where left out.
VehicleMix ReadMix(const config::Map& map);

}  // namespace rodeira::traffic
