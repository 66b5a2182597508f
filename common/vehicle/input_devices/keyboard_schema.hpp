// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/config/schema.hpp"

namespace rodeira::input_devices {

// The keys of `rodeira: keyboard/1`.
const config::Schema& KeyboardSchema();

}  // namespace rodeira::input_devices
