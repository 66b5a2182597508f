// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/world/network/network.hpp"

namespace rodeira::sumo {

// A road's height from one station on: a + b ds + c ds² + d ds³.
struct HeightPiece {
  double s_m = 0.0, a = 0.0, b = 0.0, c = 0.0, d = 0.0;
};
using RoadHeights = std::map<std::string, std::vector<HeightPiece>>;  // by the road's id

// The ground's height at (x, y) of the network; nothing where it is not known.
using GroundHeight = std::function<std::optional<double>(const Eigen::Vector2d&)>;

// The ground of an elevation file, in the coordinates of the network: by the coordinate systems of both, or directly
// where neither has one. Wrong input where the file cannot be read, or only one of them has one.
base::Result<GroundHeight> GroundOf(const std::filesystem::path& elevation, const network::Network& network);

// Heights of roads that follow the ground, smoothed over kSmooth_m. A junction is level, or inclined along its road
// where it has only one; between junctions a road's mean grade is at most kMaxGrade, as far as junctions can move.
// Heights and grades are continuous along every way. Wrong input where the ground at a road is not known.
inline constexpr double kSmooth_m = 24.0;
inline constexpr double kMaxGrade = 0.1;
base::Result<RoadHeights> HeightsOf(const network::Network& network, const GroundHeight& ground);

// The text of an OpenDRIVE file with these heights instead of its own.
std::string WithHeights(const std::string& drive, const RoadHeights& heights);

}  // namespace rodeira::sumo
