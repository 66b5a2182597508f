// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "common/runtime/launch/node_context.hpp"
#include "common/vehicle/input_devices/force_device.hpp"
#include "common/vehicle/input_devices/wheel_driver.hpp"
#include "nodes/input/source.hpp"

namespace rodeira::nodes {

// A steering wheel with pedals, or any other joystick, as a wheel file says (docs/reference/driver-files.md). A device
// that is missing at the start is wrong input; one that is unplugged during the run is told of, its pedals are
// released, the run goes on. Where no file is named: MakeFoundSource.
base::Result<std::unique_ptr<Source>> MakeJoystickSource(const config::Map& config, launch::NodeContext& context);

// The same of one file, or of settings from anywhere. `config` may say other GUIDs (`devices`); what is wrong with
// these stays in its collection.
base::Result<std::unique_ptr<Source>> OpenWheelFile(const std::filesystem::path& file, const config::Map& config,
                                                    const std::string& node);
// Opens the force feedback of the device of a place in the settings, which is there; null where it has none.
using MotorOpener = std::function<std::unique_ptr<input_devices::ForceDevice>(std::size_t place, bool inverted)>;
// `motor`: empty: the device's own.
base::Result<std::unique_ptr<Source>> OpenWheel(const input_devices::WheelSettings& settings, const std::string& node,
                                                MotorOpener motor = {});

}  // namespace rodeira::nodes
