// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/config/schema.hpp"

namespace rodeira::launch {

// The keys of `rodeira: launch/1`; of a node; of the mapping `transport`; of `discovery`.
const config::Schema& LaunchSchema();
const std::vector<config::Key>& NodeKeys();
const std::vector<config::Key>& TransportKeys();
const std::vector<config::Key>& DiscoveryKeys();

}  // namespace rodeira::launch
