// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "common/core/config/declared.hpp"
#include "common/world/design/context.hpp"
#include "common/world/network/laid.hpp"
#include "common/world/network/road.hpp"

namespace rodeira::design {

// A road of a world file before junctions cut it.
struct RoadDesign {
  network::RoadSpec spec;
  std::vector<geometry::PlanElement> elements;
  config::Map map;          // for what is found to be wrong later
  network::Laid laid = {};  // on its surface
};

// Reads one road; `before` are those that it may be placed at. What is wrong is a problem of the map's file; where
// there is any, the road must not be built.
RoadDesign ReadRoad(const config::DeclaredMap& keys, Context& context, const std::vector<RoadDesign>& before);

// The road as it stands, without junctions. Nothing, and a problem, where its axis cannot be.
std::optional<network::Road> BuildRoad(const RoadDesign& design);

// Whether the lanes' edges keep clear of the centres of the axis' bends: a problem names the station of the first cusp.
void CheckBends(const RoadDesign& design, const network::Road& road);

}  // namespace rodeira::design
