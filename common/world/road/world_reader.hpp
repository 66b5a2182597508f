// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "common/core/base/file_cache.hpp"
#include "common/core/base/result.hpp"
#include "common/core/config/config.hpp"
#include "common/world/road/hills.hpp"
#include "common/world/road/world_spec.hpp"

namespace rodeira::road {

// What a world file says. There is a spec where there are no problems.
struct WorldReading {
  std::optional<WorldSpec> spec;
  std::optional<HillsSpec> hills;  // where the terrain is generated
  std::vector<base::Error> problems;
  std::vector<base::Error> missing;  // pictures: wrong, but the world can be driven without them
  std::vector<std::string> warnings;
  std::vector<std::string> road_places;  // "file:line" of the network's roads that the file itself has; those that lead
                                         // through junctions are not among them
};

// Reads a world file (docs/reference/world-files.md) with the files that it names, makes its hills, and checks that all
// fits together. `cache`: of hills; null: none.
WorldReading ReadWorld(const config::File& file, base::FileCache* cache = nullptr);

}  // namespace rodeira::road
