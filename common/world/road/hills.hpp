// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/world/network/network.hpp"
#include "common/world/road/road.hpp"
#include "common/world/terrain/elevation_grid.hpp"

namespace rodeira::road {

// One layer of hills: gradient noise on a lattice of this spacing, of at most about this height up and down.
struct Relief {
  double wavelength_m = 0.0;
  double amplitude_m = 0.0;
};

// Hills made from a seed, shaped so that roads fit into them.
struct HillsSpec {
  std::uint64_t seed = 0;
  int columns = 0;
  int rows = 0;
  double west_m = 0.0;
  double south_m = 0.0;
  double spacing_m = 0.0;
  std::optional<double>
      base_z_m;          // the middle height beyond every road's reach; nothing: below_m below BaseOf the roads
  double below_m = 0.0;  // the terrain lies this much below the road's axis
  double flat_m = 0.0;   // up to this distance from a road's axis the terrain lies level with the road
  double full_m = 0.0;   // from this distance on the hills have their full height
  double reach_m = 0.0;  // from this distance on a road changes nothing, to the bit; at least full_m
  bool follow_structures = true;  // they follow roads where bridges carry them and in tunnels, too
  std::vector<Relief> relief;
  std::string projection_wkt;
};

// A point of a road's axis, and how much of the axis it stands for.
struct AxisPoint {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
  double length_m = 0.0;
};

// Points of the roads' axes, at most 20 m apart, on a network 40 m (and none of its junctions' ways, nor, without
// `structures`, where a bridge carries a road or a tunnel leads it through a hill). Those of a network's road follow
// from each of its plan elements alone: where one changes, the points on the others stay.
std::vector<AxisPoint> AxisPoints(std::span<const Road> roads);
std::vector<AxisPoint> AxisPoints(const network::Network& network, bool structures = true);

// The middle height where none is said: the mean of the axes' heights, to whole 10 m, so that it stays where a road is
// changed a little; 0 without any road.
double BaseOf(std::span<const AxisPoint> axis);

// Where the terrain's posts stand.
terrain::ElevationGrid::Frame FrameOf(const HillsSpec& spec);

// The terrain: the mean of the roads' heights, less below_m, each point of their axes weighted by its length times (1 -
// (d / reach)^2)^3 / (d^2 + flat^2)^2 of its distance d, by nothing from reach_m on, and of base_z_m, weighted by 4 /
// reach^3, which is about as much as a straight road half of reach_m away counts; plus the relief, which grows from
// nothing at flat_m to all of it at full_m. So height and slope go on everywhere without a step, and what a road's
// points change ends at reach_m. A pure function of its arguments that uses sums, products, quotients and square roots
// only.
terrain::ElevationGrid MakeHills(const HillsSpec& spec, std::span<const AxisPoint> axis);
inline terrain::ElevationGrid MakeHills(const HillsSpec& spec, std::span<const Road> roads) {
  return MakeHills(spec, AxisPoints(roads));
}

}  // namespace rodeira::road
