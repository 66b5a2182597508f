// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/vehicle/dynamics/vehicle_model.hpp"

namespace rodeira::dynamics {

// What a user of a loaded vehicle should know once, a sentence each: what its tyre files lack and what was put in its
// place, units of an FMU that are converted, a state of it that cannot be taken over. `file`: the vehicle file.
std::vector<std::string> NotesOn(const VehicleModel& model, const std::filesystem::path& file);

}  // namespace rodeira::dynamics
