#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "common/base/result.hpp"
#include "common/road/world.hpp"
#include "common/scenario/request.hpp"
#include "common/scene/moment.hpp"
#include "common/scene/pick.hpp"

namespace rodeira::view {

// The vehicle nodes by the ids of their cars in a moment.
using CarNames = std::map<std::uint64_t, std::string>;

// What a person asks for who points at the ground: the followed car (of the traffic: the first driven one) there, along the lane if there
// is one, otherwise as it stands. Wrong input where there is no car, no ground there, or not under all of the car.
base::Result<scenario::Request> AskPlace(const road::World& world, const scene::Moment& moment, std::size_t followed, const scene::Ray& ray, const CarNames& names);

}  // namespace rodeira::view
