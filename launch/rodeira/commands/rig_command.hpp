// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "launch/rodeira/commands/vehicle_command.hpp"

namespace rodeira::cli {

// `rodeira vehicle rig`: the suspensions of a multibody car on a bench. Prints their figures as drawn; with `out` it
// writes travel.csv, travel.svg, steering.csv and steering.svg there. `options.file` is a path. Returns the exit
// status: 2 for wrong input.
int SuspensionBench(const VehicleOptions& options);

}  // namespace rodeira::cli
