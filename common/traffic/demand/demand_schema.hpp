// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/core/config/schema.hpp"

namespace rodeira::traffic {

// The keys `routes`, `flows` and `turns`.
const std::vector<config::Key>& DemandKeys();
// The keys of a mix: the kinds of vehicles.
const std::vector<config::Key>& MixKeys();
// A list of kinds of vehicles.
config::Key KindsKey(std::string name, std::string meaning);

}  // namespace rodeira::traffic
