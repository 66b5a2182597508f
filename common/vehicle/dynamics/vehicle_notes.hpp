// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/core/config/config.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"

namespace rodeira::dynamics {

// What a user of a loaded vehicle should know once, a sentence each: what its tyre files lack and what was put in its
// place, units of an FMU that are converted, a state of it that cannot be taken over, and values that no
// road vehicle has. `file`: the vehicle file.
std::vector<std::string> NotesOn(const VehicleModel& model, const std::filesystem::path& file);

// Values of a vehicle file that can be computed with and that no road vehicle has, a sentence each with its place and
// what is usual: a spring of 22 N/m, a side force of the wrong sign. `root`: the file's top.
std::vector<std::string> UnusualValues(const config::Map& root);

}  // namespace rodeira::dynamics
