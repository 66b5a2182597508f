// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/core/config/schema.hpp"

namespace rodeira::road {

// The keys of `rodeira: world/2`.
const config::Schema& WorldSchema();

// The keys of each part.
const std::vector<config::Key>& PlaneKeys();
// Of `terrain`, of its `generate`, and of its `texture`.
const std::vector<config::Key>& TerrainKeys();
const std::vector<config::Key>& HillsKeys();
const std::vector<config::Key>& GroundPictureKeys();

}  // namespace rodeira::road
