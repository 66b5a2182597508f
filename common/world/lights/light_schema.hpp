// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/core/config/schema.hpp"

namespace rodeira::lights {

// The keys of the lights of one junction.
const std::vector<config::Key>& LightPlanKeys();

}  // namespace rodeira::lights
