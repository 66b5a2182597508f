// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osg/Group>
#include <osg/ref_ptr>

#include <vector>

#include "common/view/scene/terrain/terrain_mesh.hpp"
#include "common/view/scene/visual_world/ground_tile.hpp"
#include "nodes/view/materials/material_library.hpp"
#include "nodes/view/paging/tile_tree.hpp"

namespace rodeira::nodes {

// What stands still, as the look draws it. Several threads may ask for levels once it has made its states
// (MaterialLibrary::MakeStates).

// A network's tile at one of its levels.
osg::ref_ptr<osg::Group> LevelNode(MaterialLibrary& look, const scene::GroundLevel& level);
// All of its levels, each shown at its distances.
PlacedNode GroundNode(MaterialLibrary& look, const scene::GroundTile& tile);
// Land of a world without roads.
PlacedNode TerrainNode(MaterialLibrary& look, const scene::TerrainTile& tile);

}  // namespace rodeira::nodes
