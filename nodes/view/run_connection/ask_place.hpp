// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "common/core/base/result.hpp"
#include "common/driving/scenario/request.hpp"
#include "common/view/scene/camera/pick.hpp"
#include "common/view/scene/vehicles/scene_snapshot.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::nodes {

// The vehicle nodes by the ids of their cars in a moment.
using CarNames = std::map<std::uint64_t, std::string>;
// Where a vehicle's node says that its car begins: at a place, or at the world's start with a heading of its own.
struct CarStart {
  std::optional<double> x_m, y_m;  // both or none
  std::optional<double> heading_deg;
};
using CarStarts = std::map<std::uint64_t, CarStart>;
// The same in a world: what is not said is the world's.
struct StartPlace {
  double x_m = 0.0, y_m = 0.0, heading_deg = 0.0;
};
// In W; a place of its own without a heading faces east.
StartPlace PlaceOfStart(const road::World& world, const CarStart& own);

// What a person asks for by pointing at the ground: the followed car (of the traffic: the first driven one) there,
// along the lane if there is one, otherwise as it stands. Wrong input where there is no car, no ground there, or not
// under all of the car.
base::Result<scenario::Request> AskPlace(const road::World& world, const scene::SceneSnapshot& moment,
                                         std::size_t followed, const scene::Ray& ray, const CarNames& names);
// The same car where it began: at its own start, or the world's. Wrong input where there is no car.
base::Result<scenario::Request> AskStart(const road::World& world, const scene::SceneSnapshot& moment,
                                         std::size_t followed, const CarNames& names, const CarStarts& starts);

}  // namespace rodeira::nodes
