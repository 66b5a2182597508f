// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/vehicle/input_devices/joysticks.hpp"
#include "launch/rodeira/doctor/finding.hpp"

namespace rodeira::cli {

// `rodeira joysticks [--watch]`: what is plugged in, by the GUIDs that a wheel file names, and what moves.
struct JoysticksOptions {
  bool watch = false;
  std::optional<double> duration_s;  // of watching; otherwise until Ctrl-C
};
// Returns the exit status.
int ListJoysticks(const JoysticksOptions& options);

// A table of what is plugged in, a line a device; what to do where there is none.
std::string JoystickTable(const std::vector<input_devices::JoystickInfo>& connected);
// "axis 2: 32767 -> 1200" and "button 4: down", a line each, for what differs by more than a hundredth of an axis' way;
// `before` is brought up to date for those.
std::string JoystickMoves(const std::string& device, input_devices::DeviceReading& before,
                          const input_devices::DeviceReading& now);

// The line of `rodeira doctor`: information, and a warning where devices are there that this person may not read.
Finding CheckJoysticks(const std::vector<input_devices::JoystickInfo>& connected,
                       const std::filesystem::path& input_folder = "/dev/input");

}  // namespace rodeira::cli
