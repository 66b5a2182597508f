// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/world/opendrive/read.hpp"

// How reference lines that do not hang together are repaired.
namespace rodeira::opendrive {

inline constexpr double kBridgedAlong_m = 0.3, kBridgedAcross_m = 0.1;  // larger gaps end the road, or the lane's way
inline constexpr double kFolded_rad = 1.2;  // a larger kink within a road ends it: its lanes would fold
inline constexpr double kBridge_m = 5.0;    // the last part of an element that a bridge takes the place of

// A gap between element `next` and the one before: bridged, or the road ends there.
Repair GapRepair(Source& source, const RoadReading& road, std::size_t next);
// A kink between element `next` and the one before: kept up to kFolded_rad; a larger one ends the road there.
Repair KinkRepair(Source& source, const RoadReading& road, std::size_t next, double kink_rad);
// An element that begins elsewhere along the line than the one before ends.
Repair StationRepair(Source& source, const RoadReading& road, std::size_t next);
// A cubic with a curve that is not as long as its element says.
Repair CubicRepair(Source& source, const RoadReading& road, std::size_t element);
// The road's length is set to the end of its last element.
Repair LengthRepair(Source& source, const RoadReading& road);
// A section beside its road or behind a later one: the first begins with the road, another is removed. No repair where
// the file has no such element.
Repair SectionRepair(Source& source, const RoadReading& road, std::size_t section);

}  // namespace rodeira::opendrive
