// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/core/config/schema.hpp"

namespace rodeira::design {

// The keys of a junction.
const std::vector<config::Key>& JunctionKeys();

}  // namespace rodeira::design
