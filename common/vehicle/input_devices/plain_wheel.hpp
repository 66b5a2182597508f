// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "common/vehicle/input_devices/wheel_driver.hpp"

namespace rodeira::input_devices {

// A guess at a device that was not set up, as most wheels are: steering on axis 0; of four axes and more throttle
// and brake on 2 and 3, of three on 1 and 2, pressed towards their low end; of two both pedals on axis 1. Gears up and
// down are buttons 4 and 5, or 0 and 1 where there are fewer. Nothing where it has fewer than two axes.
std::optional<WheelSettings> PlainWheel(const DeviceUse& device, std::size_t axes, std::size_t buttons);

// "steering on axis 0, throttle on 2, brake on 3".
std::string AxesText(const WheelSettings& settings);

}  // namespace rodeira::input_devices
