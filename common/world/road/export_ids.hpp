// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/world/network/network.hpp"

namespace rodeira::road {

// What an OpenDRIVE file is written of.
struct ExportParts {
  std::vector<network::Road> roads;
  std::vector<network::Controller> controllers;
  std::vector<network::Junction> junctions;
};

// The same roads, junctions, controllers and things under ids that other programs take: blanks and what SUMO refuses in
// an id (any of | \ ' " ; , : < > & * ? ! # and control characters) are
// '_', and an id that is there already by that gets "_2", "_3" …; others stay as they are. Names, which hold what their
// author wrote, stay.
ExportParts WithPlainIds(const network::Network& network);

}  // namespace rodeira::road
