// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "common/view/scene/heat_map/heat_map.hpp"

namespace rodeira::scene {

// A statistic over the ground as a picture, a pixel a square, for a shader that lays it over whatever ground is there.
// A square may have two surfaces, one over the other: a road and the bridge across it.
struct HeatRaster {
  double west_m = 0.0, south_m = 0.0;    // its lower left corner
  double lowest_m = 0.0, range_m = 1.0;  // of its heights
  std::size_t columns = 0, rows = 0;     // none: no vehicle has been anywhere
  // Rows from the south, four numbers a square: of the lower surface its share of the scale (0 red … 65535 green) and
  // its height (0: there is none; 65535 is lowest_m + range_m), and both of the upper one.
  std::vector<std::uint16_t> texels;

  // Four numbers. Precondition: column < columns, row < rows.
  const std::uint16_t* At(std::size_t column, std::size_t row) const { return &texels[4 * (row * columns + column)]; }
};

// On a square, ways with heights that differ by less lie on one surface; and what is less far from it in height belongs
// to it.
inline constexpr double kHeatSurface_m = 2.5;
inline constexpr std::int64_t kHeatReach = 1024;  // squares on each side of a place, at most: 4 km

// What is known of the ground about a place.
HeatRaster MakeHeatRaster(const HeatMap& map, HeatKind kind, const Eigen::Vector3d& about_W);

}  // namespace rodeira::scene
