// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/editor/commands.hpp"

// Whole junctions in one gesture, in right-hand traffic: all curves, lanes, connections and signs, with start and end
// lanes, so that traffic drives on them at once.
namespace rodeira::editor {

// Where a template is put, and its measures.
struct TemplatePlace {
  Eigen::Vector2d middle_W = Eigen::Vector2d::Zero();
  double heading_rad = 0.0;  // of the first arm, from east to north
  double lane_m = 3.25;      // width of a lane, 2.5 to 5
  double arm_m = 60.0;       // length of each arm, 20 to 500
};

enum class Template { kCrossing, kRoundabout, kMerge };

// Crossing: four arms, all turns, STOP on the second and fourth. Roundabout: four arms, a ring of 16 m radius, give-way
// signs where it is entered. Merge: a road that runs along the heading, a second one joins it from the right at 15
// degrees.
base::Result<Edit> Place(Document& document, Template what, const TemplatePlace& place);

}  // namespace rodeira::editor
