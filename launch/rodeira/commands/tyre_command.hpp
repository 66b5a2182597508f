// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "launch/rodeira/commands/vehicle_command.hpp"

namespace rodeira::cli {

// `rodeira vehicle tyre FILE`: reads a tyre file as a vehicle file does, tells what is missing in it as warnings,
// prints stiffness and peaks at four loads, and draws the forces. Returns the exit status: 2 for wrong input.
int Tyre(const VehicleOptions& options);

}  // namespace rodeira::cli
