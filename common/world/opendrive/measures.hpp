// SPDX-License-Identifier: Apache-2.0
#pragma once

// How far, high and large what an OpenDRIVE file describes may be: far beyond what is built, and near enough that
// everything which looks at it comes to an end.
namespace rodeira::opendrive {

inline constexpr double kWidest_m = 1000.0;  // a lane; its border, the lane offset and a mark's place beside the line
inline constexpr double kWidestSide_m = 10000.0;  // all lanes on one side of a road
inline constexpr double kHighest_m = 20000.0;     // a road over the zero of heights, and below it
inline constexpr double kAboveLine_m = 1000.0;    // a road's surface beside its line, over it and below it
inline constexpr double kHighestLane_m = 100.0;   // a lane over its road
inline constexpr double kSteepest_rad = 1.5;      // bank
inline constexpr double kWidestMark_m = 100.0;
inline constexpr double kLargestThing_m = 10000.0;  // an object or a signal, and how far it stands from its road's line
inline constexpr double kMaxTurns = 20.0;           // of an element of a road's line
inline constexpr double kMaxScale = 1000.0;         // of a measured surface's heights
// Shorter ones are a slip: a pattern of dashes that is repeated more often is painted as a line, a row of things goes
// on as one body.
inline constexpr double kShortestPattern_m = 0.1, kShortestDistance_m = 0.01;

}  // namespace rodeira::opendrive
