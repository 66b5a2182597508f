// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/base/file_cache.hpp"
#include "common/view/scene/road_furniture/static_objects.hpp"
#include "common/world/road/world.hpp"
#include "nodes/view/materials/material_library.hpp"
#include "nodes/view/paging/paged_world.hpp"

namespace rodeira::nodes {

// The ground of a world that has a network, made where the eye comes near, tile by tile and level by level, as that of
// a built database is read there. What is seen of a tile does not depend on when it was made, nor by which thread.
// World, look and cache must outlive the root. `is_there`: which models from files can be drawn. `cache`: of tiles that
// were made before; null: none.
PagedWorld BuildVisualWorld(const road::World& world, MaterialLibrary& look, scene::ModelIsThere is_there,
                            base::FileCache* cache);

}  // namespace rodeira::nodes
