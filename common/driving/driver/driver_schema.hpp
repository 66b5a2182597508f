// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/config/schema.hpp"

namespace rodeira::driver {

// The keys of `rodeira: driver/1`.
const config::Schema& DriverSchema();

}  // namespace rodeira::driver
