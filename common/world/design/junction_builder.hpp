// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/world/design/junction_reader.hpp"
#include "common/world/design/junction_surface.hpp"
#include "common/world/network/network.hpp"

namespace rodeira::design {

// A road between two junctions (or a whole one): where it comes from.
struct Piece {
  std::size_t design = 0;
  double from_s_m = 0.0, to_s_m = 0.0;
};

// Roads cut where junctions lie, and what joins them.
struct Layout {
  network::NetworkSpec network;  // the pieces come first
  std::vector<Piece> pieces;
  std::vector<std::pair<std::size_t, Piece>>
      along;  // roads that go straight on through a junction: which, and where they come from
  std::vector<std::shared_ptr<const JunctionSurface>> surfaces;
};

// Cuts the roads, makes the ways through the junctions (straight on along the road, otherwise cubics from lane to
// lane), their surfaces, marks and signs. Problems where junctions leave no road between them.
Layout BuildLayout(const std::vector<RoadDesign>& designs, const std::vector<network::Road>& roads,
                   const std::vector<JunctionSpec>& junctions);

}  // namespace rodeira::design
