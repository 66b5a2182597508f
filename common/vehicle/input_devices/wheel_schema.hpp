// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/config/schema.hpp"

namespace rodeira::input_devices {

// The keys of `rodeira: wheel/1`.
const config::Schema& WheelSchema();
// An axis of a device, with `centre` where it has two sides; a button; the keys of `force`.
const std::vector<config::Key>& AxisKeys(bool two_sided);
const std::vector<config::Key>& SteeringKeys();
const std::vector<config::Key>& ButtonKeys();
const std::vector<config::Key>& ForceKeys();

}  // namespace rodeira::input_devices
