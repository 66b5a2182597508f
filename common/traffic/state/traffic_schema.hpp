// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/config/schema.hpp"

namespace rodeira::traffic {

inline constexpr std::int64_t kMaxVehicles = 100'000;

// The keys of `rodeira: traffic/1`.
const config::Schema& TrafficSchema();

}  // namespace rodeira::traffic
