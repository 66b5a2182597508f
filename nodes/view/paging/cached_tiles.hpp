// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/core/base/file_cache.hpp"
#include "nodes/view/paging/database_tiles.hpp"

namespace rodeira::nodes {

// TilesOf a world that has a network, with what the cache holds of them: the same files and levels, to the bit. What
// the tiles are made from is prepared when the first one is asked for that the cache does not hold. Null: no cache; it
// must outlive the tiles.
std::unique_ptr<DatabaseTiles> CachedTilesOf(const road::World& world, unsigned threads, scene::ModelIsThere is_there,
                                             base::FileCache* cache);

}  // namespace rodeira::nodes
