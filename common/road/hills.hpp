#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/network/network.hpp"
#include "common/road/road.hpp"
#include "common/terrain/elevation_grid.hpp"

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
  double base_z_m = 0.0;  // the middle height where there is no road
  double below_m = 0.0;   // the terrain lies this much below the road's axis
  double flat_m = 0.0;    // up to this distance from a road's axis the terrain lies level with the road
  double full_m = 0.0;    // from this distance on the hills have their full height
  std::vector<Relief> relief;
  std::string projection_wkt;
};

// Points of the roads' axes, with their heights: every 20 m, on a network every 40 m (and none of its junctions' ways).
std::vector<Eigen::Vector3d> AxisPoints(std::span<const Road> roads);
std::vector<Eigen::Vector3d> AxisPoints(const network::Network& network);

// The terrain: the mean of the roads' heights, weighted by 1 / (d^2 + flat^2)^2 of the distance d to points of their axes,
// less below_m, plus the relief, which grows from nothing at flat_m to all of it at full_m. A pure function of its arguments that uses
// sums, products, quotients and square roots only.
terrain::ElevationGrid MakeHills(const HillsSpec& spec, std::span<const Eigen::Vector3d> axis_W);
inline terrain::ElevationGrid MakeHills(const HillsSpec& spec, std::span<const Road> roads) { return MakeHills(spec, AxisPoints(roads)); }

}  // namespace rodeira::road
