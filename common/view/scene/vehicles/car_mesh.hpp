// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "common/view/scene/mesh/mesh.hpp"
#include "common/view/scene/vehicles/scene_snapshot.hpp"

namespace rodeira::scene {

// The measures of a car to be drawn, in its own frame B (x forward, y left, z up, ground at z = 0 when at rest).
struct CarShape {
  double front_m = 2.01;  // front bumper
  double length_m = 3.85;
  double width_m = 1.65;
  double height_m = 1.42;
  double wheel_radius_m = 0.2915;
  double wheel_width_m = 0.175;
  std::array<Eigen::Vector3d, 4> hubs_B;  // front left, front right, rear left, rear right, at rest
  double tread_out_m = 0.0;  // how far a wheel is drawn farther out than it is, to stand flush with the body

  // The driver's car as it stands on its wheels.
  static CarShape Of(const CarPose& car);
  // Of a vehicle of the traffic.
  static CarShape Of(const AgentPose& agent);
};

// A small hatchback, every part a closed surface.
struct CarMeshes {
  std::vector<Mesh> body;   // paint, glass, trim, lamps
  std::vector<Mesh> frame;  // what would stand in the driver's eyes: posts, mirrors
  Mesh lamps;               // kCarLamp, all of them
  std::vector<Mesh> wheel;  // about its hub, axle along y; the same for all four

  // A closed part that shines as this lamp does.
  void AddLamp(Lamp lamp, Mesh part);
};
// In frame B.
CarMeshes BuildCar(const CarShape& shape, Colour paint);
// Of any kind but a pedestrian.
CarMeshes BuildVehicle(AgentKind kind, const CarShape& shape, Colour paint);

}  // namespace rodeira::scene
