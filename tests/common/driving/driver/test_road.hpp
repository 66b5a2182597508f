// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "common/world/road/road_network.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::driver {

inline road::RoadSpec TwoLanes(std::vector<geometry::PlanPiece> pieces, double limit_mps,
                               std::vector<geometry::GradePoint> grades) {
  road::RoadSpec spec;
  spec.id = "test";
  spec.heading_rad = 0.3;
  spec.pieces = std::move(pieces);
  spec.grade_points = std::move(grades);
  for (const int id : {-1, 1}) {
    road::Lane lane;
    lane.id = id;
    lane.direction = id < 0 ? 1 : -1;
    lane.width_m = 3.0;
    lane.speed_limit_mps = limit_mps;
    spec.section.lanes.push_back(lane);
  }
  spec.section.left = spec.section.right = {0.5, 0.025, ground::Surface::kAsphalt};
  spec.section.verge = {1.0, 0.05, ground::Surface::kGrass};
  return spec;
}

// The world of such a road on a plane.
inline std::shared_ptr<const road::World> WorldOf(const road::RoadSpec& spec) {
  road::WorldSpec world;
  world.name = "test";
  world.network = road::AsNetwork(world.name, "", std::vector{road::Road(spec)}, world.friction);
  world.plane = road::PlaneSpec{};
  return road::World::Make(std::move(world));
}

// Straight and level.
inline road::RoadSpec StraightRoad(double length_m, double limit_mps, double grade = 0.0) {
  return TwoLanes({{length_m, 0.0, 0.0}}, limit_mps, {{0.0, 0.0, 0.0}, {length_m, grade * length_m, 0.0}});
}
inline std::shared_ptr<const road::World> StraightWorld(double length_m, double limit_mps, double grade = 0.0) {
  return WorldOf(StraightRoad(length_m, limit_mps, grade));
}

// Bends to both sides between clothoids, down to 35 m, on a grade up and down.
inline road::RoadSpec WindingRoad(double limit_mps = 20.0) {
  std::vector<geometry::PlanPiece> pieces{{120.0, 0.0, 0.0}};
  for (const double radius : {80.0, -40.0, 150.0, -35.0, 60.0, 35.0, -100.0}) {
    const double k = 1.0 / radius;
    pieces.push_back({18.0, 0.0, k});
    pieces.push_back({40.0, k, k});
    pieces.push_back({18.0, k, 0.0});
    pieces.push_back({60.0, 0.0, 0.0});
  }
  double length = 0.0;
  for (const auto& piece : pieces) length += piece.length_m;
  return TwoLanes(std::move(pieces), limit_mps,
                  {{0.0, 0.0, 0.0}, {300.0, 15.0, 100.0}, {600.0, -3.0, 120.0}, {length, 5.0, 0.0}});
}
inline std::shared_ptr<const road::World> WindingWorld(double limit_mps = 20.0) {
  return WorldOf(WindingRoad(limit_mps));
}

}  // namespace rodeira::driver
