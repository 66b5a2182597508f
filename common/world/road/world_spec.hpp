// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/hash.hpp"
#include "common/core/ground/ground.hpp"
#include "common/world/design/junction_surface.hpp"
#include "common/world/network/network.hpp"
#include "common/world/network/props.hpp"
#include "common/world/road/surface_point.hpp"
#include "common/world/terrain/elevation_grid.hpp"
#include "common/world/terrain/picture_file.hpp"

namespace rodeira::road {

class SurfaceDetail;

// Where the driver's car stands when the simulation begins.
struct StartPose {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;  // from east to north
  // On a road: which one (an index into World::network()->roads()), which lane, where along it. Otherwise -1, 0, 0.
  int road = -1;
  int lane = 0;
  double s_m = 0.0;
};

// An unbounded inclined plane: z = z_m + slope_x x + slope_y y.
struct PlaneSpec {
  double z_m = 0.0;
  double slope_x = 0.0;
  double slope_y = 0.0;
};

// What a World is made from: the world file, understood and checked.
struct WorldSpec {
  std::string name;
  std::shared_ptr<const terrain::ElevationGrid> grid;  // one of these two, or an OpenDRIVE file
  std::optional<PlaneSpec> plane;
  std::shared_ptr<const network::Network> network;  // null: no roads
  base::Digest network_hash = 0;  // of the bytes of an OpenDRIVE file, or of a traffic map and what stands beside it
  std::vector<std::shared_ptr<const design::JunctionSurface>> junctions;  // of a network that is built into the terrain
  std::shared_ptr<const network::Props> props;                            // what stands at no road; null: nothing
  std::shared_ptr<const SurfaceDetail> detail;  // what stands on the network's roads; null: nothing
  ground::Surface terrain_surface = ground::Surface::kGrass;
  std::optional<terrain::LaidPicture> ground_picture;  // only to be seen
  std::optional<double> terrain_friction;              // otherwise its surface's
  FrictionTable friction = kUsualFriction;
  StartPose start;
  std::vector<std::string> warnings;  // what was repaired in an OpenDRIVE file: one sentence a kind
};

}  // namespace rodeira::road
