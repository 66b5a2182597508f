// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <pugixml.hpp>

// What SUMO's lanes need so that a car can drive from an edge into the next one.
namespace rodeira::sumo {

// A lane of SUMO has one width from end to end, and netconvert draws lanes from the left: where a lane is wider than
// the one that it comes from, all to its right lie aside. Lanes that do not meet within 0.05 m across a way get the
// width of the lane before, and widen over 6 m a metre, at least 5 m; where the road behind is shorter, the road before
// is the one that changes. Returns how many ways this is done for. Widths of `drive` are those of netconvert.
std::size_t FitWidths(pugi::xml_node drive);

// A way over a junction that netconvert draws as a line with kinks above 0.35 rad becomes a curve, if its lanes meet
// the lanes on both sides and a car can turn on all of them (4.5 m). Returns how many.
std::size_t BendKinkedWays(pugi::xml_node drive);

}  // namespace rodeira::sumo
