// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/view/scene/mesh/mesh.hpp"

// What stands at roads, made of few triangles, each in its own frame: x along the road, the road to the left (y), z up
// from the ground. `level`: of detail, 0 the finest; from 3 on only what is as large as a house is there.
namespace rodeira::scene {

constexpr double kPost_m = 0.038;       // radius of a sign's post
constexpr double kLightHousing = 0.17;  // half the width of a traffic light, of its height

// Of an upright box about the model.
struct ModelSize {
  double length_m = 0.0;  // along x
  double width_m = 0.0;   // along y
  double height_m = 0.0;
};

// A house with a gable roof; its colours follow from `seed`. It goes on below the ground, which may slope.
Mesh HouseModel(const ModelSize& size, std::uint64_t seed, int level);
// A roof on four pillars over two rows of pumps, and a shop behind it.
Mesh FillingStationModel(const ModelSize& size, int level);
// A marker post: white, with a black band and a reflector on both sides.
Mesh PostModel(const ModelSize& size, int level);
// A street lamp with its arm to the road.
Mesh LampModel(const ModelSize& size, int level);
// A block, or with a radius a round pillar.
Mesh PlainModel(const ModelSize& size, double radius_m, Colour colour, int level);
// A signal with three lights, dark, which faces x; from its lower edge on.
Mesh TrafficLightModel(double height_m, int level);
// One of its lights, lit: a disc before the dark one. which: 0 green, 1 amber, 2 red.
Mesh LitLightModel(double height_m, std::size_t which);

}  // namespace rodeira::scene
