#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/network/network.hpp"
#include "common/opendrive/import.hpp"
#include "common/opendrive/read.hpp"

// What must fit together. Findings go to the two lists of Findings.
namespace rodeira::opendrive {

struct Findings {
  std::vector<Finding> errors, warnings;
};

// The end of a sentence about a gap: that it is too large, or that it is closed, and what ASAM's own checker allows.
std::string GapWords(double found, double most, double asam, std::string_view unit);

// Elements of one road: stations, gaps and kinks between them, the lengths of cubics, the road's length.
void CheckPlan(const RoadReading& road, const Tolerance& tolerance, Findings& findings);
// Borders of lanes that lie within the edge of the lane inside of them.
void CheckBorders(const RoadReading& road, const Tolerance& tolerance, Findings& findings);
// One warning for a file whose reference lines have jumps of curvature: at the largest of them.
void TellCurvatureJumps(std::span<const RoadReading> roads, Findings& findings);
// Junctions with a boundary and heights of their own: the ground of each, laid under its connecting roads too.
void LayJunctionGrounds(std::span<const JunctionReading> junctions, const Tolerance& tolerance, network::NetworkSpec& spec, Findings& findings);
// Roads and junctions: that what is linked exists, is meant by both sides, meets, and is not ambiguous.
void CheckRoadLinks(const network::Network& network, std::span<const RoadLines> lines, const Tolerance& tolerance,
                    Findings& findings);
// Lanes: that what is linked exists, is linked back, and meets.
void CheckLaneLinks(const network::Network& network, std::span<const RoadLines> lines, const Tolerance& tolerance,
                    Findings& findings);

}  // namespace rodeira::opendrive
