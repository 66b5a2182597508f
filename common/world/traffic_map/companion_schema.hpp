// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/config/schema.hpp"

namespace rodeira::traffic_map {

// The keys of `rodeira: motors/1`, the file FILE.motors.yaml beside a map.
const config::Schema& CompanionSchema();

}  // namespace rodeira::traffic_map
