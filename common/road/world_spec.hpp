#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/base/hash.hpp"
#include "common/network/network.hpp"
#include "common/road/road.hpp"
#include "common/terrain/elevation_grid.hpp"
#include "common/terrain/ground.hpp"

namespace rodeira::road {

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

// Coefficients by surface, indexed by the Surface's number; 1 is dry asphalt. The loose grounds are the adhesion
// coefficients that textbooks give (J. Y. Wong, Theory of Ground Vehicles, table 1.3: gravel 0.6, earth 0.65), paint is
// a little smoother than what it is painted on.
using FrictionTable = std::array<double, 7>;
inline constexpr FrictionTable kUsualFriction = {0.0, 1.0, 1.0, 0.6, 0.55, 0.65, 0.9};

// What a World is made from: the world file, understood and checked.
struct WorldSpec {
  std::string name;
  std::vector<RoadSpec> roads;
  std::shared_ptr<const terrain::ElevationGrid> grid;  // one of these two, or an OpenDRIVE file
  std::optional<PlaneSpec> plane;
  std::shared_ptr<const network::Network> network;  // null: made of `roads`, where there are any
  base::Digest network_hash = 0;                    // of an OpenDRIVE file's bytes
  terrain::Surface terrain_surface = terrain::Surface::kGrass;
  std::optional<double> terrain_friction;  // otherwise its surface's
  FrictionTable friction = kUsualFriction;
  StartPose start;
};

}  // namespace rodeira::road
