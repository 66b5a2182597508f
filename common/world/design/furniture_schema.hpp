// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/core/config/schema.hpp"

namespace rodeira::design {

// The keys of what stands at a road and of what is painted on it, of each an item of its list.
const config::Key& MarkingItem();
const std::vector<config::Key>& SignKeys();
const std::vector<config::Key>& ObjectKeys();
// Of an object at no road.
const std::vector<config::Key>& PropKeys();

}  // namespace rodeira::design
