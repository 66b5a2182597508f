// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "common/core/geometry/polyline.hpp"

namespace rodeira::geometry {

// How far a node moves along its mitre.
enum class Mitre {
  kKeepWidth,   // the distance divided by the cosine of half the deflection: every segment moves by the distance
  kKeepLength,  // the distance itself: bends become narrower (the DriS simulator's rule)
};

// Where each node goes for an offset of 1 m to the left, in plan: the unit vectors from the node towards both
// neighbours are added; the sum lies along the mitre, and is turned where it points to the right. Where the segments
// are collinear the perpendicular is used, at the ends that of the first and last segment. A closed line has no ends.
// The sharpest turn that is kept wide is kSharpest_rad; beyond it a node moves as far as there.
std::vector<Eigen::Vector2d> MitreVectors(const Polyline& line, Mitre mitre);
inline constexpr double kSharpest_rad = 2.8;  // 160 degrees

// Where an offset line is no line beside the other any more.
struct OffsetFault {
  enum class Kind { kCusp, kCrossing, kSharp } kind = Kind::kCusp;
  // kCusp: it runs backward between these stations of the original line: the bend is sharper than the offset.
  // kCrossing: it crosses itself where these stations come to lie; the original does not.
  // kSharp: the original turns back at `from_m` (both the same).
  double from_m = 0.0;
  double to_m = 0.0;
};

// A line beside another one, and where it is no good line.
struct OffsetLine {
  Polyline line;
  std::vector<OffsetFault> faults;  // cusps, turns, crossings; each kind by ascending stations
};

// The line beside this one, `left_m` to its left (negative: to its right), of as many points at the same heights.
OffsetLine Offset(const Polyline& line, double left_m, Mitre mitre = Mitre::kKeepWidth);

// One sentence: "the offset folds between stations 12.3 m and 15.6 m …".
std::string FaultText(const OffsetFault& fault, double left_m);

}  // namespace rodeira::geometry
