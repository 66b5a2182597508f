// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "common/core/base/result.hpp"
#include "nodes/view/materials/material_library.hpp"
#include "nodes/view/paging/paged_world.hpp"

namespace rodeira::nodes {

// Reads `world.osgb` of a folder that FindBuilt found: its tiles are read where the eye comes near. Every tile gets
// this look as it is read, which must outlive the root. A failure where OpenSceneGraph cannot read the file.
base::Result<PagedWorld> ReadBuilt(const std::filesystem::path& folder, MaterialLibrary& look);

}  // namespace rodeira::nodes
