// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "common/view/scene/raster/canvas.hpp"
#include "common/world/network/furniture.hpp"

// Faces of traffic signs after the Vienna Convention on Road Signs and Signals (1968), drawn by shapes.
namespace rodeira::scene {

// The name of a signal's face: a kind, and what is written on it, "speed_limit 50", "town Bouça". Signals with the
// numbers of the German catalogue (StVO; most OpenDRIVE files use them, for the country "OpenDRIVE" too) have one of
// ours; a board "board", which is white, a display "display", which is dark; every other one "plate", which is grey;
// what is only paint on the road an empty name. bends_left: where a chevron points.
std::string FaceOf(const network::Signal& signal, bool bends_left);

// The kinds that have a picture of their own, in alphabetical order.
const std::vector<std::string>& FaceKinds();

// The face's picture, a pure function of its name; 128 pixels high. What is not drawn by the plate's outline is its
// ground.
Raster DrawFace(std::string_view face);

// The plate's corners, counter-clockwise as its reader sees it, in its box from (0, 0) to (1, 1). Convex.
std::vector<Eigen::Vector2d> PlateOutline(std::string_view face);

// Width and height of a plate without a size in its file.
Eigen::Vector2d UsualPlate_m(std::string_view face);

}  // namespace rodeira::scene
