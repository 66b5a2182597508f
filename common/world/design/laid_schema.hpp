// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/core/config/schema.hpp"

namespace rodeira::design {

// The keys of a bridge or tunnel, of a surface, of a patch and of a bump of a road.
const std::vector<config::Key>& StructureKeys();
const std::vector<config::Key>& SurfaceKeys();
const std::vector<config::Key>& PatchKeys();
const std::vector<config::Key>& BumpKeys();

}  // namespace rodeira::design
