// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/core/config/config.hpp"
#include "common/world/design/junction_surface.hpp"
#include "common/world/design/road_fit.hpp"
#include "common/world/network/laid.hpp"
#include "common/world/network/network.hpp"
#include "common/world/network/props.hpp"

namespace rodeira::design {

// Where a car starts, as an author says it: a road of the file, not a part of one.
struct StartSpec {
  std::string road;  // empty: the first one
  std::optional<int> lane;
  std::optional<double> s_m;
};
// The same in the network: index of the road, the lane's id and s of that road.
struct StartPlace {
  std::uint32_t road = 0;
  int lane = 0;
  double s_m = 0.0;
};

// Roads and junctions of a world file of version 2.
struct Design {
  std::shared_ptr<const network::Network> network;  // null: the file has no roads, or problems
  std::vector<network::Laid> laid;                  // by the network's road; empty: nothing is laid on any of them
  std::vector<std::shared_ptr<const JunctionSurface>> junctions;
  network::Props props;  // what stands at no road
  std::optional<StartPlace> start;
  std::vector<std::string> warnings;
  std::vector<std::string> road_places;  // "file:line" where the network's roads are said; those that lead through
                                         // junctions, which come last, are not among them
  std::vector<base::Error> missing;      // pictures: wrong, but the world can be driven without them
  std::vector<base::Error> problems;     // of included files; those of the file itself are with it
};

// Reads 'include', 'rule', 'materials', 'templates', 'roads', 'junctions' and 'objects' of a file and of all files that
// it includes. `friction` by surface. The start, where it is on a road, must be on a lane outside of the junctions;
// `start_map` has it. Places of the elevation file's map are moved by `move`. Roads must keep within the terrain, and
// clear of themselves (CheckFits).
Design ReadDesign(const config::File& file, const std::array<double, 7>& friction, const std::string& name,
                  const std::string& geo_reference, const StartSpec& start, const config::Map& start_map,
                  const TerrainIsAt& terrain_is_at = {}, const terrain::GroundMove& move = {});

}  // namespace rodeira::design
