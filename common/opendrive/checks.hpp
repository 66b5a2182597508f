#pragma once

#include <span>
#include <vector>

#include "common/network/network.hpp"
#include "common/opendrive/import.hpp"
#include "common/opendrive/read.hpp"

// What must fit together. Findings go to the two lists of Findings.
namespace rodeira::opendrive {

struct Findings {
  std::vector<Finding> errors, warnings;
};

// Elements of one road: stations, gaps and kinks between them, the lengths of cubics, the road's length.
void CheckPlan(const RoadReading& road, const Tolerance& tolerance, Findings& findings);
// Junctions with a boundary and heights of their own: the ground of each, laid under its connecting roads too.
void LayJunctionGrounds(std::span<const JunctionReading> junctions, const Tolerance& tolerance, network::NetworkSpec& spec, Findings& findings);
// Roads and junctions: that what is linked exists, is meant by both sides, meets, and is not ambiguous.
void CheckRoadLinks(const network::Network& network, std::span<const RoadLines> lines, const Tolerance& tolerance,
                    Findings& findings);
// Lanes: that what is linked exists, is linked back, and meets.
void CheckLaneLinks(const network::Network& network, std::span<const RoadLines> lines, const Tolerance& tolerance,
                    Findings& findings);

}  // namespace rodeira::opendrive
