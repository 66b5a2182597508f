// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "common/vehicle/input_devices/wheel_driver.hpp"

namespace rodeira::input_devices {

// As wheel files call them, in the order of WheelAxis and WheelButton.
inline constexpr std::array<const char*, kWheelAxes> kAxisNames{"steering", "throttle",  "brake",
                                                                "clutch",   "handbrake", "pedals"};
inline constexpr std::array<const char*, kWheelButtons> kButtonNames{
    "gear_up",       "gear_down",  "gearbox_mode", "clutch",  "handbrake", "starter", "indicate_left", "indicate_right",
    "hazard_lights", "headlights", "horn",         "reverse", "neutral",   "drive",   "camera",        "pause"};

}  // namespace rodeira::input_devices
