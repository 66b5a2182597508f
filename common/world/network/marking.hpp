// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/world/network/road.hpp"
#include "common/world/network/strokes.hpp"

// Lane marks and painted lines alike, as single lines: what of them is painted, and where.
namespace rodeira::network {

// One line of paint: along a lane's outer edge (lane 0: the centre), or one of RoadSpec::lines. Valid while its road
// is.
struct Marking {
  std::uint32_t section = 0;
  int lane = 0;
  const PaintedLine* painted = nullptr;        // null: along the edge
  const geometry::CubicTable* sway = nullptr;  // of the edge's mark, over s
  double from_s_m = 0.0, to_s_m = 0.0;
  double t_offset_m = 0.0;
  double width_m = 0.12;
  double stroke_m = 0.0, gap_m = 0.0;  // gap 0: continuous. Both along the line's own length in plan
  double first_m = 0.0;                // of the first stroke, from the beginning
  std::string_view colour;             // the names of RoadMark::colour
};

// How lines are painted of which a mark only says the type: strokes and gaps outside of towns, the distance of the
// middles of two lines beside one another (Vienna Convention, annex 2: a gap of 0.10 to 0.18 m), the width by weight.
inline constexpr double kStroke_m = 4.0, kGap_m = 8.0, kDot_m = 0.1, kDotGap_m = 1.0, kBetween_m = 0.14;
inline constexpr double kStandardWidth_m = 0.12, kBoldWidth_m = 0.25;

// All lines of a road, in the order of sections, lanes from right to left, marks; its painted lines last. Of a type of
// two words the first is the inner line (of a centre: the left one). Types that paint nothing (none, curb, edge, grass)
// and marks of no width or length are left out. A broken mark without lines of its own goes on in step from one record,
// or lane section, to the next.
std::vector<Marking> MarkingsOf(const Road& road);
// t of the line's middle at s, which is held in its section, and how it moves.
geometry::CubicPoint MarkingAt(const Road& road, const Marking& marking, double s_m);
// The line's own length in plan.
double MarkingLength(const Road& road, const Marking& marking, double from_s_m, double to_s_m);
// What is painted, in ascending order.
std::vector<Stroke> StrokesOf(const Road& road, const Marking& marking);

}  // namespace rodeira::network
