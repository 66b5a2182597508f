// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "common/core/config/schema.hpp"

namespace rodeira::design {

// The keys of a road, and of an element of its axis: `line`, `arc`, `clothoid` or `from`.
const std::vector<config::Key>& RoadKeys();
const std::vector<config::Key>& ElementKeys(std::string_view kind);

}  // namespace rodeira::design
